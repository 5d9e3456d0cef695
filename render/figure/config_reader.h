#pragma once

#include <yaml-cpp/yaml.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "morph/mesh/errors.h"
#include "render/figure/config.h"
#include "render/figure/config_sources.h"
#include "render/figure/names.h"

/// Tables of keys that read a YAML mapping into a struct. Internal to the config readers: with
/// config_sources.h the only header that shows yaml-cpp.
namespace automorph::config {

/// What a reader needs to say where it is.
struct Place {
    const Sources& sources;
    std::string path = {};  ///< of the section being read, e.g. "picture"; empty at the top

    std::string at(const std::string& key) const { return path.empty() ? key : path + "." + key; }
    Place inner(const std::string& key) const { return {sources, at(key)}; }
    [[noreturn]] void fail(const YAML::Mark& mark, const std::string& message) const;
};

/// One key of a section that fills a T.
template <class T>
struct Key {
    ConfigKey info;  ///< path holds the bare name
    std::function<void(T&, const YAML::Node&, const Place&)> read;
    std::function<void(std::vector<ConfigKey>&, const std::string& prefix)>
        describe_children;  ///< may be empty
};

/// A mapping that fills a T.
template <class T>
struct Section {
    std::vector<Key<T>> keys;
    std::string
        shorthand;  ///< a plain scalar in place of the mapping is the value of this key; empty: not allowed
    std::function<void(const T&, const YAML::Node&, const Place&)> check;  ///< what no single key can say
};

/// Strict readers of single values; `key` says what is allowed and is quoted in errors.
/// @throws ConfigError
std::string read_text(const YAML::Node& node, const ConfigKey& key, const Place& place);
std::uint64_t read_integer(const YAML::Node& node, const ConfigKey& key, const Place& place);
double read_number(const YAML::Node& node, const ConfigKey& key, const Place& place);
bool read_boolean(const YAML::Node& node, const ConfigKey& key, const Place& place);
std::vector<double> read_numbers(const YAML::Node& node, const ConfigKey& key, const Place& place);
std::size_t read_choice(const YAML::Node& node, const ConfigKey& key, const Place& place);

/// Checks that the node is a mapping of known keys, each once, with a value and its `only_with` met.
/// @throws ConfigError
void check_keys(const YAML::Node& node, const std::vector<const ConfigKey*>& keys, const Place& place);

/// Checks that all required keys are there. @throws ConfigError
void check_required(const YAML::Node& node, const std::vector<const ConfigKey*>& keys, const Place& place);

/// A shortest text that reads back to the same number.
std::string number_text(double value);
std::string numbers_text(const double* values, std::size_t count);

/// Position of the key's name in the mapping, else of the mapping.
YAML::Mark mark_of(const YAML::Node& mapping, const std::string& name);

template <class T>
void read_section(T& into, const YAML::Node& node, const Section<T>& section, const Place& place) {
    if (node.IsScalar() && !section.shorthand.empty()) {
        for (const Key<T>& key : section.keys) {
            if (key.info.path == section.shorthand) key.read(into, node, place);
        }
    } else {
        std::vector<const ConfigKey*> known;
        for (const Key<T>& key : section.keys) known.push_back(&key.info);
        check_keys(node, known, place);
        for (const Key<T>& key : section.keys) {
            if (const YAML::Node value = node[key.info.path]) key.read(into, value, place);
        }
        check_required(node, known, place);
    }
    if (section.check) section.check(into, node, place);
}

template <class T>
void describe(const Section<T>& section, const std::string& prefix, std::vector<ConfigKey>& into) {
    for (const Key<T>& key : section.keys) {
        into.push_back(key.info);
        into.back().path = prefix + key.info.path;
        if (key.describe_children) key.describe_children(into, prefix + key.info.path);
    }
}

// Makers of keys: the type follows from the member, the default from a default-constructed T.

struct Range {
    double least, most;
};
inline constexpr Range kAny{-1e12, 1e12};                ///< keeps coordinates far from overflow, no more
inline constexpr Range kSeed{0, 1.8446744073709551e19};  ///< whatever 64 bits hold

template <class T>
Key<T> blank(const char* name, ConfigKey::Type type, const char* meaning) {
    Key<T> key;
    key.info.path = name;
    key.info.type = type;
    key.info.meaning = meaning;
    return key;
}

template <class T>
Key<T> text(const char* name, std::string T::*member, const char* meaning) {
    Key<T> key = blank<T>(name, ConfigKey::Type::Text, meaning);
    key.info.fallback = (T{}.*member).empty() ? "" : '"' + T{}.*member + '"';
    key.read = [member, info = key.info](T& into, const YAML::Node& node, const Place& place) {
        into.*member = read_text(node, info, place);
    };
    return key;
}

template <class T>
Key<T> path(const char* name, std::filesystem::path T::*member, const char* meaning) {
    Key<T> key = blank<T>(name, ConfigKey::Type::Path, meaning);
    key.read = [member, info = key.info](T& into, const YAML::Node& node, const Place& place) {
        const std::filesystem::path found = read_text(node, info, place);
        into.*member = (place.sources.folder_of(node.Mark()) / found).lexically_normal();
    };
    return key;
}

template <class T, class M>
requires std::is_integral_v<M> &&
    (!std::is_same_v<M, bool>)Key<T> value(const char* name, M T::*member, Range range, const char* meaning) {
    Key<T> key = blank<T>(name, ConfigKey::Type::Integer, meaning);
    key.info.least = range.least;
    key.info.most = range.most;
    key.info.fallback = std::to_string(T{}.*member);
    key.read = [member, info = key.info](T& into, const YAML::Node& node, const Place& place) {
        into.*member = static_cast<M>(read_integer(node, info, place));
    };
    return key;
}

template <class T>
Key<T> value(const char* name, double T::*member, Range range, const char* meaning) {
    Key<T> key = blank<T>(name, ConfigKey::Type::Number, meaning);
    key.info.least = range.least;
    key.info.most = range.most;
    key.info.fallback = number_text(T{}.*member);
    key.read = [member, info = key.info](T& into, const YAML::Node& node, const Place& place) {
        into.*member = read_number(node, info, place);
    };
    return key;
}

template <class T>
Key<T> flag(const char* name, bool T::*member, const char* meaning) {
    Key<T> key = blank<T>(name, ConfigKey::Type::Boolean, meaning);
    key.info.fallback = T{}.*member ? "true" : "false";
    key.read = [member, info = key.info](T& into, const YAML::Node& node, const Place& place) {
        into.*member = read_boolean(node, info, place);
    };
    return key;
}

template <class T>
Key<T> vector3(const char* name, Eigen::Vector3d T::*member, Range range, const char* meaning) {
    Key<T> key = blank<T>(name, ConfigKey::Type::Numbers, meaning);
    key.info.count = 3;
    key.info.least = range.least;
    key.info.most = range.most;
    const T defaults{};
    key.info.fallback = numbers_text((defaults.*member).data(), 3);
    key.read = [member, info = key.info](T& into, const YAML::Node& node, const Place& place) {
        const std::vector<double> found = read_numbers(node, info, place);
        into.*member = {found[0], found[1], found[2]};
    };
    return key;
}

template <class T>
Key<T> numbers(const char* name, std::vector<double> T::*member, Range range, const char* meaning) {
    Key<T> key = blank<T>(name, ConfigKey::Type::Numbers, meaning);
    key.info.least = range.least;
    key.info.most = range.most;
    const T defaults{};
    key.info.fallback = numbers_text((defaults.*member).data(), (defaults.*member).size());
    key.read = [member, info = key.info](T& into, const YAML::Node& node, const Place& place) {
        into.*member = read_numbers(node, info, place);
    };
    return key;
}

template <class T, class M, std::size_t N>
Key<T> choice(const char* name, M T::*member, const std::array<Named<M>, N>& choices, const char* meaning) {
    Key<T> key = blank<T>(name, ConfigKey::Type::Choice, meaning);
    for (const Named<M>& each : choices) {
        key.info.choices.emplace_back(each.name);
        if (each.value == T{}.*member && key.info.fallback.empty()) key.info.fallback = each.name;
    }
    key.read = [member, choices, info = key.info](T& into, const YAML::Node& node, const Place& place) {
        into.*member = choices[read_choice(node, info, place)].value;
    };
    return key;
}

template <class T, class U>
Key<T> section(const char* name, U T::*member, const Section<U>& table, const char* meaning) {
    Key<T> key = blank<T>(name, ConfigKey::Type::Section, meaning);
    key.info.shorthand = table.shorthand;
    key.read = [member, table, info = key.info](T& into, const YAML::Node& node, const Place& place) {
        read_section(into.*member, node, table, place.inner(info.path));
    };
    key.describe_children = [table](std::vector<ConfigKey>& into, const std::string& prefix) {
        describe(table, prefix + ".", into);
    };
    return key;
}

/// A non-empty list of mappings. @param blank  what each of its elements is before it is read
template <class U>
void read_list(std::vector<U>& into, const YAML::Node& node, const Section<U>& table, const ConfigKey& key,
               const Place& place, const U& blank) {
    if (!node.IsSequence() || node.size() == 0) {
        place.fail(node.Mark(),
                   place.at(key.path) + ": expected a list of at least one mapping ('- key: value')");
    }
    into.clear();
    for (std::size_t i = 0; i < node.size(); ++i) {
        const Place inner = place.inner(key.path + "[" + std::to_string(i) + "]");
        read_section(into.emplace_back(blank), node[i], table, inner);
    }
}

template <class T, class U>
Key<T> list(const char* name, std::vector<U> T::*member, const Section<U>& table, const char* meaning) {
    Key<T> key = blank<T>(name, ConfigKey::Type::List, meaning);
    key.read = [member, table, info = key.info](T& into, const YAML::Node& node, const Place& place) {
        read_list(into.*member, node, table, info, place, U{});
    };
    key.describe_children = [table](std::vector<ConfigKey>& into, const std::string& prefix) {
        describe(table, prefix + "[].", into);
    };
    return key;
}

/// A key of a part stands beside those of the whole: `shape: star, arms: 6`.
template <class T, class U>
Key<T> of(U T::*part, Key<U> inner) {
    Key<T> key{inner.info, {}, inner.describe_children};
    key.read = [part, read = inner.read](T& into, const YAML::Node& node, const Place& place) {
        read(into.*part, node, place);
    };
    return key;
}

template <class T>
Key<T> required(Key<T> key) {
    key.info.required = true;
    key.info.fallback.clear();
    return key;
}

/// The key makes sense only beside `condition`, e.g. "shape: star".
template <class T>
Key<T> only_with(const char* condition, Key<T> key) {
    key.info.only_with = condition;
    return key;
}

}  // namespace automorph::config
