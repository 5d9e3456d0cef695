#include "render/figure/config_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "render/figure/suggestion.h"

namespace automorph::config {
namespace {

std::string shortened(const std::string& text) {
    return text.size() > 60 ? text.substr(0, 57) + "..." : text;
}

/// How an error quotes what stands in the file.
std::string found(const YAML::Node& node) {
    switch (node.Type()) {
        case YAML::NodeType::Null:
            return "found nothing";
        case YAML::NodeType::Sequence:
            return fmt::format("found a list of {}", node.size());
        case YAML::NodeType::Map:
            return "found a mapping";
        default:
            break;
    }
    return "found '" + shortened(node.Scalar()) + "'";
}

[[noreturn]] void reject(const YAML::Node& node, const ConfigKey& key, const Place& place) {
    place.fail(node.Mark(),
               fmt::format("{}: {}, expected {}", place.at(key.path), found(node), allowed_values(key)));
}

/// A scalar without quotes; a quoted "12" is text, not a number.
bool is_plain(const YAML::Node& node) {
    return node.IsScalar() && node.Tag() != "!";
}

template <class N>
std::optional<N> whole_text_as(std::string_view text) {
    N value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

/// A decimal number or a fraction such as 1/3.
std::optional<double> number_of(const std::string& text) {
    const std::size_t slash = text.find('/');
    const std::optional<double> above = whole_text_as<double>(std::string_view(text).substr(0, slash));
    if (!above || slash == std::string::npos) return above;
    const std::optional<double> below = whole_text_as<double>(std::string_view(text).substr(slash + 1));
    if (!below) return std::nullopt;
    return *above / *below;
}

std::optional<double> number_within(const YAML::Node& node, const ConfigKey& key) {
    if (!is_plain(node)) return std::nullopt;
    const std::optional<double> value = number_of(node.Scalar());
    const bool allowed = value && std::isfinite(*value) && (!key.least || *value >= *key.least) &&
                         (!key.most || *value <= *key.most);
    return allowed ? value : std::nullopt;
}

/// True if the mapping holds what "name: value" says.
bool holds(const YAML::Node& node, const std::string& condition) {
    const std::size_t colon = condition.find(": ");
    const YAML::Node value = node[condition.substr(0, colon)];
    return value && value.IsScalar() && value.Scalar() == condition.substr(colon + 2);
}

}  // namespace

void Place::fail(const YAML::Mark& mark, const std::string& message) const {
    std::string line = message;  // keys and values may be of several
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    throw ConfigError(fmt::format("{}: {}", sources.where(mark), line));
}

std::string read_text(const YAML::Node& node, const ConfigKey& key, const Place& place) {
    if (!node.IsScalar() || node.Scalar().empty()) reject(node, key, place);
    return node.Scalar();
}

std::uint64_t read_integer(const YAML::Node& node, const ConfigKey& key, const Place& place) {
    // Exact above 2^53 too, where seeds may lie: the range is compared as a double, the value is not one.
    const std::optional<std::uint64_t> value =
        is_plain(node) ? whole_text_as<std::uint64_t>(node.Scalar()) : std::nullopt;
    if (!value || !number_within(node, key)) reject(node, key, place);
    return *value;
}

double read_number(const YAML::Node& node, const ConfigKey& key, const Place& place) {
    const std::optional<double> value = number_within(node, key);
    if (!value) reject(node, key, place);
    return *value;
}

bool read_boolean(const YAML::Node& node, const ConfigKey& key, const Place& place) {
    if (!is_plain(node) || (node.Scalar() != "true" && node.Scalar() != "false")) reject(node, key, place);
    return node.Scalar() == "true";
}

std::vector<double> read_numbers(const YAML::Node& node, const ConfigKey& key, const Place& place) {
    if (!node.IsSequence() || node.size() == 0) reject(node, key, place);
    if (key.count > 0 && node.size() != static_cast<std::size_t>(key.count)) reject(node, key, place);
    std::vector<double> values;
    for (std::size_t i = 0; i < node.size(); ++i) {
        const std::optional<double> value = number_within(node[i], key);
        if (!value) {
            place.fail(node[i].Mark(), fmt::format("{}[{}]: {}, expected {}", place.at(key.path), i,
                                                   found(node[i]), allowed_values(key)));
        }
        values.push_back(*value);
    }
    return values;
}

std::size_t read_choice(const YAML::Node& node, const ConfigKey& key, const Place& place) {
    if (!node.IsScalar()) reject(node, key, place);
    const auto choice = std::find(key.choices.begin(), key.choices.end(), node.Scalar());
    if (choice == key.choices.end()) {
        place.fail(node.Mark(), fmt::format("{}: {}, expected {}{}", place.at(key.path), found(node),
                                            allowed_values(key), suggestion(node.Scalar(), key.choices)));
    }
    return static_cast<std::size_t>(choice - key.choices.begin());
}

void check_keys(const YAML::Node& node, const std::vector<const ConfigKey*>& keys, const Place& place) {
    const std::string where = place.path.empty() ? "the config" : place.path;
    std::vector<std::string> names;
    for (const ConfigKey* key : keys) names.push_back(key->path);
    if (!node.IsMap()) {
        place.fail(node.Mark(), fmt::format("{}: {}, expected a mapping of {}", where, found(node),
                                            fmt::join(names, ", ")));
    }
    std::vector<std::string> seen;
    for (const auto& entry : node) {
        const std::string name = entry.first.IsScalar() ? entry.first.Scalar() : "";
        const auto known = std::find(names.begin(), names.end(), name);
        if (known == names.end()) {
            place.fail(entry.first.Mark(),
                       fmt::format("unknown key '{}' in {}{}; allowed are {}", shortened(name), where,
                                   suggestion(name, names), fmt::join(names, ", ")));
        }
        if (std::find(seen.begin(), seen.end(), name) != seen.end()) {
            place.fail(entry.first.Mark(), fmt::format("'{}' is given twice in {}", name, where));
        }
        seen.push_back(name);
        const ConfigKey& key = *keys[static_cast<std::size_t>(known - names.begin())];
        if (entry.second.IsNull()) {  // its own mark is the next token's
            place.fail(entry.first.Mark(),
                       fmt::format("{}: found nothing, expected {}", place.at(name), allowed_values(key)));
        }
        if (!key.only_with.empty() && !holds(node, key.only_with)) {
            place.fail(entry.first.Mark(),
                       fmt::format("{} has a meaning only beside '{}'", place.at(name), key.only_with));
        }
    }
}

void check_required(const YAML::Node& node, const std::vector<const ConfigKey*>& keys, const Place& place) {
    const std::string where = place.path.empty() ? "the config" : place.path;
    for (const ConfigKey* key : keys) {
        if (key->required && !node[key->path]) {
            place.fail(node.Mark(), fmt::format("'{}' is missing in {}: {}", key->path, where, key->meaning));
        }
    }
}

std::string number_text(double value) {
    return fmt::format("{}", value);
}

std::string numbers_text(const double* values, std::size_t count) {
    return fmt::format("[{}]", fmt::join(values, values + count, ", "));
}

YAML::Mark mark_of(const YAML::Node& mapping, const std::string& name) {
    if (!mapping.IsMap()) return mapping.Mark();
    for (const auto& entry : mapping) {
        if (entry.first.IsScalar() && entry.first.Scalar() == name) return entry.first.Mark();
    }
    return mapping.Mark();
}

}  // namespace automorph::config
