#include <nlohmann/json.hpp>

#include <algorithm>

#include "render/figure/config.h"

namespace automorph {
namespace {

using Json = nlohmann::ordered_json;

/// Numbers may be fractions, which YAML reads as text.
constexpr const char* kFraction = "^-?[0-9.]+([eE][-+]?[0-9]+)?/-?[0-9.]+([eE][-+]?[0-9]+)?$";

Json number_schema(const ConfigKey& key) {
    Json number = {{"type", "number"}};
    if (key.least) number["minimum"] = *key.least;
    if (key.most) number["maximum"] = *key.most;
    return {{"anyOf", Json::array({number, {{"type", "string"}, {"pattern", kFraction}}})}};
}

/// Seeds take all of 64 bits, which no double bounds exactly: there the limit is left out.
Json integer_schema(const ConfigKey& key) {
    constexpr double kExact = 9007199254740992.0;  // 2^53
    Json integer = {{"type", "integer"}};
    if (key.least) integer["minimum"] = static_cast<std::int64_t>(*key.least);
    if (key.most && *key.most < kExact) integer["maximum"] = static_cast<std::int64_t>(*key.most);
    return integer;
}

Json empty_mapping() {
    return {{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
}

/// Choices as editors see them in YAML: `8` is a number there, `true` a boolean.
Json choices_schema(const ConfigKey& key) {
    Json choices = Json::array();
    for (const std::string& choice : key.choices) {
        const Json plain = Json::parse(choice, nullptr, false);
        choices.push_back(plain.is_number() || plain.is_boolean() ? plain : Json(choice));
    }
    return choices;
}

Json value_schema(const ConfigKey& key) {
    switch (key.type) {
        case ConfigKey::Type::Text:
        case ConfigKey::Type::Path:
            return {{"type", "string"}, {"minLength", 1}};
        case ConfigKey::Type::Integer:
            return integer_schema(key);
        case ConfigKey::Type::Number:
            return number_schema(key);
        case ConfigKey::Type::Boolean:
            return {{"type", "boolean"}};
        case ConfigKey::Type::Choice:
            return {{"enum", choices_schema(key)}};
        case ConfigKey::Type::Numbers: {
            Json list = {
                {"type", "array"}, {"items", number_schema(key)}, {"minItems", std::max(1, key.count)}};
            if (key.count > 0) list["maxItems"] = key.count;
            return list;
        }
        case ConfigKey::Type::Section:
            if (!key.shorthand.empty())
                return {{"anyOf", Json::array({empty_mapping(), {{"type", "string"}, {"minLength", 1}}})}};
            return empty_mapping();
        case ConfigKey::Type::List:
            return {{"type", "array"}, {"minItems", 1}, {"items", empty_mapping()}};
    }
    return {};
}

std::string description(const ConfigKey& key) {
    std::string text = key.meaning;
    if (!key.fallback.empty()) text += "; default " + key.fallback;
    if (!key.only_with.empty()) text += "; only beside '" + key.only_with + "'";
    return text;
}

/// The mapping that a schema of a section or of a list's entries holds.
Json& mapping_of(Json& schema) {
    if (schema.contains("anyOf")) return schema["anyOf"][0];
    if (schema.contains("items")) return schema["items"];
    return schema;
}

}  // namespace

std::string config_schema() {
    Json root = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "A figure of automorph"}};
    root.update(empty_mapping());
    for (const ConfigKey& key : config_keys()) {
        Json* mapping = &root;
        std::size_t begin = 0;
        for (std::size_t dot; (dot = key.path.find('.', begin)) != std::string::npos; begin = dot + 1) {
            std::string name = key.path.substr(begin, dot - begin);
            if (name.size() > 2 && name.ends_with("[]")) name.erase(name.size() - 2);
            mapping = &mapping_of((*mapping)["properties"][name]);
        }
        const std::string name = key.path.substr(begin);
        Json schema = {{"description", description(key)}};
        schema.update(value_schema(key));
        (*mapping)["properties"][name] = schema;
        if (key.required) (*mapping)["required"].push_back(name);
    }
    // What a config lacks may stand in the one that it extends.
    root["if"] = {{"required", Json::array({"extends"})}};
    root["else"] = {{"required", root["required"]}};
    root.erase("required");
    return root.dump(2) + "\n";
}

}  // namespace automorph
