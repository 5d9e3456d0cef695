#pragma once

#include <string>
#include <vector>

/// The command line as data: what completion and man page are made of, so that they cannot tell of options
/// that do not exist.
namespace CLI {
class App;
}

namespace automorph::program {

struct OptionEntry {
    std::vector<std::string> flags;  ///< "--out", "-q"; empty: it is positional
    std::string name;                ///< of the value of a positional one, e.g. "SOURCE"
    std::string value;               ///< kind of value: "MESH", "FILE", "N", "none|dense", ...; empty: a flag
    std::string limits;              ///< "in [2 - 100]"; may be empty
    std::string fallback;            ///< default; may be empty
    std::string meaning;
    bool required = false;

    bool positional() const { return flags.empty(); }
    /// The words that `value` allows; empty unless it lists them.
    std::vector<std::string> choices() const;
};

struct CommandEntry {
    std::vector<std::string> path;  ///< {"shape", "star"}; empty for the program itself
    std::string about, footer;
    std::vector<OptionEntry> options;
    std::vector<CommandEntry> commands;

    std::string name() const { return path.empty() ? "automorph" : path.back(); }
    std::string full_name() const;  ///< "automorph shape star"
    std::string key() const;        ///< "/shape/star"; empty for the program itself
    /// Flags whose next word is their value.
    std::vector<std::string> flags_with_value() const;
};

CommandEntry command_tree(const CLI::App& app);

/// The commands right below, given or not.
std::vector<const CLI::App*> every_command(const CLI::App& app);

}  // namespace automorph::program
