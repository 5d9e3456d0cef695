#pragma once

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

/// The subcommands `help` and `completion`, which print what the command line itself says.
namespace automorph::program {

struct TextArguments {
    std::vector<std::string> topic;  ///< a topic's name, or the words of a command
    bool man = false;
    std::string shell;
};

/// @pre all other commands are there: help names them
void add_texts(CLI::App& app, TextArguments& arguments);

/// Prints what was asked for and returns the status to exit with; empty if neither command was given.
std::optional<int> print_text(const CLI::App& app, const TextArguments& arguments);

}  // namespace automorph::program
