#include "render/figure/config.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>
#include <iterator>
#include <sstream>

#include "render/figure/config_keys.h"

namespace automorph {
namespace {

std::string range_text(const ConfigKey& key) {
    // Ranges that only keep numbers sane are not worth a reader's time.
    constexpr double kUnbounded = 1e9;
    const bool below = key.least && *key.least > -kUnbounded, above = key.most && *key.most < kUnbounded;
    if (below && above) return fmt::format(" from {} to {}", *key.least, *key.most);
    if (below) return fmt::format(" of at least {}", *key.least);
    if (above) return fmt::format(" of at most {}", *key.most);
    return "";
}

/// yaml-cpp does not say that a tab is to blame.
std::string about_tabs(const std::string& text) {
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        const std::size_t begin = line.find_first_not_of(' ');
        if (begin != line.npos && line[begin] == '\t')
            return fmt::format("; line {} is indented by a tab, YAML takes spaces only", number);
    }
    return "";
}

}  // namespace

FigureConfig load_config(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    if (file == "-") return parse_config({std::istreambuf_iterator<char>(std::cin), {}}, "stdin", overrides);
    return parse_config(config::read_config_text(file), file, overrides);
}

FigureConfig parse_config(const std::string& text, const std::filesystem::path& file,
                          const std::vector<std::string>& overrides) {
    config::Sources sources;
    const config::Place place{sources};
    FigureConfig figure;
    figure.file = file;
    figure.text = text;
    figure.overrides = overrides;
    figure.output = std::filesystem::path("out") / file.stem();
    try {
        const YAML::Node top = config::read_documents(sources, text, file, figure.bases);
        for (const std::string& each : overrides) config::apply_override(sources, top, each);
        config::read_section(figure, top, config::figure_section(), place);
    } catch (const YAML::Exception& error) {
        // Syntax errors, and whatever else yaml-cpp objects to.
        place.fail(error.mark, error.msg + about_tabs(text));
    }
    return figure;
}

std::string config_hash(const FigureConfig& config) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    const auto add = [&](const std::string& text) {
        for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
        hash = (hash ^ 0xffu) * 0x100000001b3u;  // no byte of UTF-8: ends the text
    };
    add(config.text);
    for (const ConfigText& base : config.bases) add(base.text);
    for (const std::string& each : config.overrides) add(each);
    return fmt::format("fnv1a64:{:016x}", hash);
}

std::vector<ConfigKey> config_keys() {
    std::vector<ConfigKey> keys;
    config::describe(config::figure_section(), "", keys);
    return keys;
}

std::string allowed_values(const ConfigKey& key) {
    switch (key.type) {
        case ConfigKey::Type::Text:
            return "text";
        case ConfigKey::Type::Path:
            return "a path";
        case ConfigKey::Type::Integer:
            return "an integer" + range_text(key);
        case ConfigKey::Type::Number:
            return "a number" + range_text(key);
        case ConfigKey::Type::Boolean:
            return "true or false";
        case ConfigKey::Type::Choice:
            return fmt::format("one of {}", fmt::join(key.choices, ", "));
        case ConfigKey::Type::Numbers:
            return fmt::format("a list of {}numbers, each{}",
                               key.count > 0 ? fmt::format("{} ", key.count) : "",
                               range_text(key).empty() ? " finite" : range_text(key));
        case ConfigKey::Type::Section:
            return "a mapping";
        case ConfigKey::Type::List:
            return "a list of mappings";
    }
    return "";
}

std::string explain_config() {
    std::string text =
        "A figure's config is a YAML file. Relative paths are relative to the folder of the file they stand "
        "in.\n"
        "Numbers may be fractions (1/3). Unknown keys are errors. 'automorph config --schema' prints a JSON "
        "Schema "
        "for editors.\n\n";
    for (const ConfigKey& key : config_keys()) {
        text += fmt::format("{}\n    {}\n    takes {}", key.path, key.meaning, allowed_values(key));
        if (key.required) text += "; required";
        if (!key.fallback.empty()) text += fmt::format("; default {}", key.fallback);
        if (!key.only_with.empty()) text += fmt::format("; only beside '{}'", key.only_with);
        text += "\n";
    }
    return text;
}

}  // namespace automorph
