#include "render/program/command_tree.h"

#include <CLI/CLI.hpp>

namespace automorph::program {
namespace {

OptionEntry entry(const CLI::Option& option) {
    OptionEntry result;
    for (const std::string& name : option.get_lnames()) result.flags.push_back("--" + name);
    for (const std::string& name : option.get_snames()) result.flags.push_back("-" + name);
    if (result.flags.empty()) result.name = option.get_name(true);
    if (option.get_items_expected_max() > 0) {
        // CLI11 joins the kind and its checks: "N:INT in [2 - 100]".
        const std::string type = option.get_type_name();
        const auto colon = type.find(':');
        result.value = type.substr(0, colon);
        if (colon != std::string::npos) {
            const std::string check = type.substr(colon + 1);
            const auto in = check.find("in [");
            result.limits = in == std::string::npos ? check : check.substr(in);
        }
        result.fallback = option.get_default_str();
    }
    result.meaning = option.get_description();
    result.required = option.get_required();
    return result;
}

CommandEntry entry(const CLI::App& app, std::vector<std::string> path) {
    CommandEntry result;
    result.path = std::move(path);
    result.about = app.get_description();
    result.footer = app.get_footer();
    for (const CLI::Option* option : app.get_options([](const CLI::Option*) { return true; })) {
        result.options.push_back(entry(*option));
    }
    for (const CLI::App* command : every_command(app)) {
        std::vector<std::string> below = result.path;
        below.push_back(command->get_name());
        result.commands.push_back(entry(*command, std::move(below)));
    }
    return result;
}

}  // namespace

std::vector<std::string> OptionEntry::choices() const {
    std::vector<std::string> words;
    if (value.find('|') == std::string::npos) return words;
    for (std::size_t begin = 0; begin <= value.size();) {
        const std::size_t end = std::min(value.find('|', begin), value.size());
        words.push_back(value.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

std::string CommandEntry::full_name() const {
    std::string text = "automorph";
    for (const std::string& word : path) text += " " + word;
    return text;
}

std::string CommandEntry::key() const {
    std::string text;
    for (const std::string& word : path) text += "/" + word;
    return text;
}

std::vector<std::string> CommandEntry::flags_with_value() const {
    std::vector<std::string> result;
    for (const OptionEntry& option : options) {
        if (!option.value.empty()) result.insert(result.end(), option.flags.begin(), option.flags.end());
    }
    return result;
}

std::vector<const CLI::App*> every_command(const CLI::App& app) {
    return app.get_subcommands([](const CLI::App*) { return true; });
}

CommandEntry command_tree(const CLI::App& app) {
    return entry(app, {});
}

}  // namespace automorph::program
