#include "render/program/man_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "render/program/help_topics.h"

namespace automorph::program {
namespace {

/// Text that troff prints as it is.
std::string escaped(const std::string& text) {
    std::string result;
    bool line_begins = true;
    for (const char c : text) {
        if (line_begins && (c == '.' || c == '\'')) result += "\\&";
        if (c == '\\') {
            result += "\\e";
        } else if (c == '-') {
            result += "\\-";
        } else {
            result += c;
        }
        line_begins = c == '\n';
    }
    return result;
}

/// Paragraphs, set as running text; indented lines as they are.
std::string paragraphs(const std::string& text) {
    std::string result, line;
    bool literal = false;
    std::istringstream lines(text);
    while (std::getline(lines, line)) {
        const bool indented = line.rfind("  ", 0) == 0;
        if (line.empty()) {
            if (!literal) result += ".PP\n";
            continue;
        }
        if (indented != literal) result += indented ? ".PP\n.nf\n" : ".fi\n.PP\n";
        literal = indented;
        result += escaped(line) + "\n";
    }
    if (literal) result += ".fi\n";
    return result;
}

std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

std::string synopsis(const CommandEntry& command) {
    std::string text = fmt::format("\\fB{}\\fR", escaped(command.full_name()));
    if (std::any_of(command.options.begin(), command.options.end(),
                    [](const OptionEntry& option) { return !option.positional(); })) {
        text += " [\\fIOPTIONS\\fR]";
    }
    for (const OptionEntry& option : command.options) {
        if (!option.positional()) continue;
        const std::string name = fmt::format("\\fI{}\\fR", escaped(option.name));
        text += option.required ? fmt::format(" {}", name) : fmt::format(" [{}]", name);
    }
    return text;
}

std::string described(const OptionEntry& option) {
    std::string text = ".TP\n";
    if (option.positional()) {
        text += fmt::format("\\fI{}\\fR", escaped(option.name));
    } else {
        std::string between;
        for (const std::string& flag : option.flags) {
            text += fmt::format("{}\\fB{}\\fR", between, escaped(flag));
            between = ", ";
        }
        if (!option.value.empty()) text += fmt::format(" \\fI{}\\fR", escaped(option.value));
    }
    text += fmt::format("\n{}", escaped(option.meaning));
    std::string more = option.limits;
    if (!option.fallback.empty())
        more += fmt::format("{}default {}", more.empty() ? "" : ", ", option.fallback);
    if (!more.empty()) text += escaped(fmt::format(" ({})", more));
    return text + "\n";
}

void add_command(std::string& text, const CommandEntry& command) {
    if (command.commands.empty()) {
        text += fmt::format(".SS {}\n{}\n.PP\n{}.\n", escaped(command.full_name().substr(10)),
                            synopsis(command), escaped(command.about));
        for (const OptionEntry& option : command.options) {
            if (option.flags != std::vector<std::string>{"--help", "-h"}) text += described(option);
        }
        if (!command.footer.empty()) text += ".PP\n" + paragraphs(command.footer);
    }
    for (const CommandEntry& below : command.commands) add_command(text, below);
}

}  // namespace

std::string man_page(const CommandEntry& program, const std::string& version) {
    std::string text = fmt::format(
        ".\\\" made by: automorph help --man\n"
        ".TH AUTOMORPH 1 \"\" \"automorph {}\" \"User Commands\"\n"
        ".SH NAME\nautomorph \\- morphs one triangle mesh into another, and pictures it\n"
        ".SH SYNOPSIS\n\\fBautomorph\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR] ...\n"
        ".SH DESCRIPTION\n{}{}.SH OPTIONS\n",
        escaped(version), paragraphs(program.about), paragraphs("\n" + program.footer));
    for (const OptionEntry& option : program.options) text += described(option);
    text += ".SH COMMANDS\n";
    for (const CommandEntry& command : program.commands) add_command(text, command);
    for (const HelpTopic& topic : help_topics()) {
        text += fmt::format(".SH {}\n{}", escaped(upper(topic.title)), paragraphs(topic.text));
    }
    text +=
        ".SH EXIT STATUS\n0 if all went well, 1 otherwise; \\fBautomorph info\\fR: 1 if a mesh cannot be "
        "morphed; "
        "\\fBautomorph diff\\fR: 1 if pictures differ, 2 if they cannot be compared.\n"
        ".SH SEE ALSO\nR. Urtasun, M. Salzmann, P. Fua: \\fI3D Morphing without User Interaction\\fR, "
        "2004.\n";
    return text;
}

}  // namespace automorph::program
