#include <fmt/format.h>
#include <fmt/ranges.h>

#include "render/program/completion.h"

namespace automorph::program {
namespace {

constexpr const char* kFishHelpers = R"(function __automorph_files -d 'Files whose names end so, and folders'
    complete -C "'' "(commandline -ct) | string match -ri "^(?:.*/|.*\.(?:$argv[1]))\$"
end
function __automorph_at -d 'Is this the command that was typed?'
    test (__automorph_command) = "$argv"
end
)";

constexpr const char* kFishBegin = R"(function __automorph_command
    set -l command ''
    set -l previous ''
    for word in (commandline -opc)[2..-1]
        # A value of the program's own options may be spelt like a command.
        if not contains -- $previous {}
            switch "$command/$word"
                case {}
                    set command "$command/$word"
            end
        end
        set previous $word
    end
    echo $command
end
complete -c automorph -f
)";

constexpr const char* kAnyFile = " -F";

std::string fish_quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) {
        if (c == '\'' || c == '\\') result += '\\';
        result += c;
    }
    return result + "'";
}

/// The arguments of `complete` for a value of this kind; empty if nothing completes it.
std::string fish_values(const OptionEntry& option) {
    const std::vector<std::string> choices = option.choices();
    if (!choices.empty())
        return fmt::format(" -a {}", fish_quoted(fmt::format("{}", fmt::join(choices, " "))));
    if (option.value == "MESH") return " -a '(__automorph_files \"off|obj|ply|stl\")'";
    if (option.value == "YAML") return " -a '(__automorph_files \"ya?ml\")'";
    if (option.value == "DIR") return " -a '(__fish_complete_directories)'";
    if (option.value == "FILE" || option.value == "PATH") return kAnyFile;
    return "";
}

/// One option, where `condition` holds; of short and long flags one line, with the meaning as description.
std::string fish_option(const OptionEntry& option, const std::string& condition) {
    std::string text = "complete -c automorph" + condition;
    for (const std::string& flag : option.flags) {
        const bool is_long = flag.rfind("--", 0) == 0;
        text += fmt::format(" {} {}", is_long ? "-l" : "-s", flag.substr(is_long ? 2 : 1));
    }
    if (!option.value.empty()) {
        // -x: what is typed here is no file unless the values say so.
        const std::string values = fish_values(option);
        text += (values == kAnyFile ? " -r" : " -x") + values;
    }
    return text + fmt::format(" -d {}\n", fish_quoted(option.meaning));
}

void add_fish_command(std::string& text, const CommandEntry& command) {
    const std::string condition =
        fmt::format(" -n {}", fish_quoted(fmt::format("__automorph_at {}", command.key())));
    for (const CommandEntry& below : command.commands) {
        text += fmt::format("complete -c automorph{} -a {} -d {}\n", condition, below.name(),
                            fish_quoted(below.about));
    }
    bool positional = false;
    for (const OptionEntry& option : command.options) {
        if (!option.positional()) {
            // Those of the program itself may stand behind every command, as --help does; --version may not.
            if (option.flags.front() == "--help" && !command.path.empty()) continue;
            const bool everywhere = command.path.empty() && option.flags.front() != "--version";
            text += fish_option(option, everywhere ? "" : condition);
        } else if (!positional) {
            text += fmt::format("complete -c automorph{}{}\n", condition, fish_values(option));
            positional = true;
        }
    }
    for (const CommandEntry& below : command.commands) add_fish_command(text, below);
}

void add_fish_paths(std::vector<std::string>& paths, const CommandEntry& command) {
    if (!command.path.empty()) paths.push_back(command.key());
    for (const CommandEntry& below : command.commands) add_fish_paths(paths, below);
}

}  // namespace

std::string fish_completion(const CommandEntry& program) {
    std::vector<std::string> paths;
    add_fish_paths(paths, program);
    std::string text = "# fish completion of automorph, made by: automorph completion fish\n";
    text += kFishHelpers;
    text += fmt::format(kFishBegin, fmt::join(program.flags_with_value(), " "), fmt::join(paths, " "));
    add_fish_command(text, program);
    return text;
}

}  // namespace automorph::program
