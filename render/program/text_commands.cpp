#include "render/program/text_commands.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "render/figure/suggestion.h"
#include "render/program/command_tree.h"
#include "render/program/completion.h"
#include "render/program/help_topics.h"
#include "render/program/man_page.h"
#include "render/program/version.h"

namespace automorph::program {
namespace {

using Completion = std::string (*)(const CommandEntry&);

/// Null for a shell that has none.
Completion completion_of(const std::string& shell) {
    if (shell == "bash") return bash_completion;
    if (shell == "fish") return fish_completion;
    if (shell == "zsh") return zsh_completion;
    return nullptr;
}

/// Prints the help of a command given by its words ("shape", "head"); false if there is none.
bool print_command_help(const CLI::App& app, const std::vector<std::string>& words) {
    const CLI::App* command = &app;
    std::string path;
    for (const std::string& word : words) {
        path += (path.empty() ? "" : " ") + command->get_name();
        const std::vector<const CLI::App*> below = every_command(*command);
        const auto found = std::find_if(below.begin(), below.end(),
                                        [&](const CLI::App* each) { return each->get_name() == word; });
        if (found == below.end()) return false;
        command = *found;
    }
    fmt::print("{}", command->help(path));
    return true;
}

int print_help(const CLI::App& app, const TextArguments& arguments) {
    if (arguments.man) {
        fmt::print("{}", man_page(command_tree(app), version()));
        return 0;
    }
    if (arguments.topic.empty()) {
        fmt::print("{}", list_of_topics());
        return 0;
    }
    const std::string topic_name = fmt::format("{}", fmt::join(arguments.topic, " "));
    for (const HelpTopic& topic : help_topics()) {
        if (topic_name == topic.name) {
            fmt::print("{}\n\n{}", topic.title, topic.text);
            return 0;
        }
    }
    if (print_command_help(app, arguments.topic)) return 0;
    std::vector<std::string> known;
    for (const HelpTopic& topic : help_topics()) known.emplace_back(topic.name);
    for (const CLI::App* command : every_command(app)) known.push_back(command->get_name());
    fmt::print(stderr, "automorph: there is no help on '{}'{} ('automorph help' lists what there is)\n",
               topic_name, suggestion(topic_name, known));
    return 1;
}

int print_completion(const CLI::App& app, const TextArguments& arguments) {
    fmt::print("{}", completion_of(arguments.shell)(command_tree(app)));
    return 0;
}

}  // namespace

void add_texts(CLI::App& app, TextArguments& arguments) {
    std::string topics;
    for (const HelpTopic& topic : help_topics()) topics += std::string(topic.name) + "|";
    for (const CLI::App* command : every_command(app)) topics += command->get_name() + "|";
    topics.pop_back();
    CLI::App* help =
        app.add_subcommand("help", "Tells more about a topic or a command, and lists the topics");
    help->add_option("TOPIC", arguments.topic, "Topic or command")->type_name(topics);
    help->add_flag("--man", arguments.man, "Print all as a manual page: automorph help --man | man -l -");
    help->footer(
        "Examples:\n"
        "  automorph help getting-started\n"
        "  automorph help shape head            the same as 'automorph shape head --help'");

    CLI::App* completion =
        app.add_subcommand("completion", "Prints a script that completes the command line");
    completion->add_option("SHELL", arguments.shell, "Which shell's")
        ->type_name("bash|fish|zsh")
        ->required()
        ->check([](const std::string& shell) {
            return completion_of(shell) ? "" : "found '" + shell + "', allowed are bash|fish|zsh";
        });
    completion->footer(
        "Examples:\n"
        "  source <(automorph completion bash)      for this shell; in ~/.bashrc for all; zsh likewise\n"
        "  automorph completion fish | source       in ~/.config/fish/config.fish for all");
}

std::optional<int> print_text(const CLI::App& app, const TextArguments& arguments) {
    if (app.got_subcommand("help")) return print_help(app, arguments);
    if (app.got_subcommand("completion")) return print_completion(app, arguments);
    return std::nullopt;
}

}  // namespace automorph::program
