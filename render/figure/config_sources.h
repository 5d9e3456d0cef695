#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <string>
#include <vector>

#include "render/figure/config.h"

/// The texts that a config is made of: its own, those it extends, and overrides from the command line.
namespace automorph::config {

/// Tells of a mark which text it is in. Lines are numbered through all texts, as each is padded in front with
/// as many empty lines as the texts before it have.
class Sources {
public:
    /// @param name      as errors call the text
    /// @param folder    of its relative paths
    /// @param has_lines whether errors tell line and column
    /// @return the padded text, to be parsed
    std::string add(const std::string& name, const std::filesystem::path& folder, bool has_lines,
                    const std::string& text);

    /// "file:line:column", counting from 1.
    std::string where(const YAML::Mark& mark) const;

    std::filesystem::path folder_of(const YAML::Mark& mark) const;

private:
    struct Source {
        std::string name;
        std::filesystem::path folder;
        bool has_lines = true;
        int first_line = 0;
    };
    const Source& source_of(const YAML::Mark& mark) const;

    std::vector<Source> sources_;
    int next_line_ = 0;
};

/// @throws IoError the file cannot be read
std::string read_config_text(const std::filesystem::path& file);

/// Parses a config and what it extends, merged.
/// @param bases  filled with the texts it extends
/// @throws ConfigError  a file extends itself, by way of others too, or what it extends cannot be read
YAML::Node read_documents(Sources& sources, const std::string& text, const std::filesystem::path& file,
                          std::vector<ConfigText>& bases);

/// Sets one key. @param text  KEY=VALUE
/// @throws ConfigError if it is not of that form or there is no such place
void apply_override(Sources& sources, const YAML::Node& top, const std::string& text);

}  // namespace automorph::config
