#include "render/program/completion.h"

#include <fmt/format.h>

namespace automorph::program {
namespace {

// What does not depend on the command line of the day. Words are split at lines alone, so that file names may
// hold spaces; no builtin is used that zsh's emulation lacks.
constexpr const char* kHelpers = R"(_automorph_words() {
    local IFS=$' \t\n'
    COMPREPLY=($(compgen -W "$1" -- "$current"))
}
_automorph_files() {  # extensions, or none for all files
    local IFS=$'\n' extension
    compopt -o filenames 2>/dev/null
    if [[ $# == 0 ]]; then
        COMPREPLY=($(compgen -f -- "$current"))
        return
    fi
    COMPREPLY=($(
        compgen -d -- "$current"
        for extension in "$@"; do compgen -f -X "!*.$extension" -- "$current"; done
    ))
}
_automorph_folders() {
    local IFS=$'\n'
    compopt -o filenames 2>/dev/null
    COMPREPLY=($(compgen -d -- "$current"))
}
)";

constexpr const char* kBegin = R"(_automorph() {
    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} command= i
    # Bash makes a word of the = in --option=value.
    if [[ $current == "=" ]]; then
        current=
    elif [[ $previous == "=" ]]; then
        previous=${COMP_WORDS[COMP_CWORD-2]}
    fi
    COMPREPLY=()
    for ((i = 1; i < COMP_CWORD; i++)); do
        # A value of the program's own options may be spelt like a command.
        case "${COMP_WORDS[i-1]}" in
)";

std::string joined(const std::vector<std::string>& words, const char* between = " ") {
    return fmt::format("{}", fmt::join(words, between));
}

/// What completes a value of this kind; empty if nothing does.
std::string values(const OptionEntry& option) {
    const std::vector<std::string> choices = option.choices();
    if (!choices.empty()) return fmt::format("_automorph_words '{}'", joined(choices));
    if (option.value == "MESH") return "_automorph_files off OFF obj OBJ ply PLY stl STL";
    if (option.value == "YAML") return "_automorph_files yaml yml";
    if (option.value == "FILE" || option.value == "PATH") return "_automorph_files";
    if (option.value == "DIR") return "_automorph_folders";
    return "";
}

void add_paths(std::string& text, const CommandEntry& command) {
    for (const CommandEntry& below : command.commands) {
        text += fmt::format("            {0}) command={0} ;;\n", below.key());
        add_paths(text, below);
    }
}

/// Options whose next word is their value.
void add_values(std::string& text, const CommandEntry& command) {
    for (const OptionEntry& option : command.options) {
        if (option.positional() || option.value.empty()) continue;
        std::vector<std::string> patterns;
        // Those of the program itself may stand behind every command.
        for (const std::string& flag : option.flags) {
            patterns.push_back(fmt::format("{}\" {}\"", command.path.empty() ? "*" : command.key(), flag));
        }
        const std::string action = values(option);
        text += fmt::format("        {}) {}return ;;\n", joined(patterns, " | "),
                            action.empty() ? "" : action + "; ");
    }
    for (const CommandEntry& below : command.commands) add_values(text, below);
}

/// What may stand where neither an option's value nor its name does: a command or a positional argument.
void add_words(std::string& text, const CommandEntry& command, const std::vector<std::string>& everywhere) {
    std::vector<std::string> flags;
    std::string action;
    for (const OptionEntry& option : command.options) {
        flags.insert(flags.end(), option.flags.begin(), option.flags.end());
        if (option.positional() && action.empty()) action = values(option);
    }
    if (!command.path.empty()) flags.insert(flags.end(), everywhere.begin(), everywhere.end());
    std::vector<std::string> commands;
    for (const CommandEntry& below : command.commands) commands.push_back(below.name());
    if (!commands.empty()) action = fmt::format("_automorph_words '{}'", joined(commands));
    text += fmt::format(
        "        \"{}\")\n"
        "            if [[ $current == -* ]]; then\n"
        "                _automorph_words '{}'\n"
        "            else\n"
        "                {}\n"
        "            fi ;;\n",
        command.key(), joined(flags), action.empty() ? ":" : action);
    for (const CommandEntry& below : command.commands) add_words(text, below, everywhere);
}

std::vector<std::string> flags_everywhere(const CommandEntry& program) {
    std::vector<std::string> flags;
    for (const OptionEntry& option : program.options) {
        for (const std::string& flag : option.flags) {
            if (flag != "--help" && flag != "-h" && flag != "--version") flags.push_back(flag);
        }
    }
    return flags;
}

std::string functions(const CommandEntry& program) {
    std::string text = std::string(kHelpers) + kBegin;
    text += fmt::format(
        "            {} | =) continue ;;\n        esac\n        case \"$command/${{COMP_WORDS[i]}}\" in\n",
        joined(program.flags_with_value(), " | "));
    add_paths(text, program);
    text += "        esac\n    done\n    case \"$command $previous\" in\n";
    add_values(text, program);
    text += "    esac\n    case \"$command\" in\n";
    add_words(text, program, flags_everywhere(program));
    text += "    esac\n}\ncomplete -F _automorph automorph\n";
    return text;
}

}  // namespace

std::string bash_completion(const CommandEntry& program) {
    return "# bash completion of automorph, made by: automorph completion bash\n" + functions(program);
}

std::string zsh_completion(const CommandEntry& program) {
    return "# zsh completion of automorph, made by: automorph completion zsh\n"
           "autoload -U +X compinit bashcompinit && compinit && bashcompinit\n" +
           functions(program);
}

}  // namespace automorph::program
