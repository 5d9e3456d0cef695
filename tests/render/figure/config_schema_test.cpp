#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "render/figure/config.h"
#include "tests/catch.h"
#include "tests/files.h"

// The JSON Schema for editors agrees with the table that reads configs. A small validator of what the schema
// uses stands in for an editor.

using namespace automorph;
using Json = nlohmann::json;
namespace fs = std::filesystem;

namespace {

/// YAML as an editor sees it: plain numbers and booleans are such, all else is text.
Json json_of(const YAML::Node& node) {
    if (node.IsMap()) {
        Json map = Json::object();
        for (const auto& entry : node) map[entry.first.Scalar()] = json_of(entry.second);
        return map;
    }
    if (node.IsSequence()) {
        Json list = Json::array();
        for (const YAML::Node& each : node) list.push_back(json_of(each));
        return list;
    }
    if (node.IsNull()) return nullptr;
    const std::string text = node.Scalar();
    if (node.Tag() == "!") return text;
    if (text == "true" || text == "false") return text == "true";
    static const std::regex kInteger("[-+]?[0-9]+"), kNumber("[-+]?[0-9]*\\.?[0-9]+([eE][-+]?[0-9]+)?");
    if (std::regex_match(text, kInteger) && text.size() < 18) return std::stoll(text);
    if (std::regex_match(text, kNumber)) return std::stod(text);
    return text;
}

bool has_type(const Json& value, const std::string& type) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "integer") return value.is_number_integer();
    return type == "number" && value.is_number();
}

/// The first thing that does not fit, with its path; empty if all fits.
std::string misfit(const Json& value, const Json& schema, const std::string& path) {
    if (schema.contains("anyOf")) {
        std::string all;
        for (const Json& option : schema["anyOf"]) {
            const std::string found = misfit(value, option, path);
            if (found.empty()) return "";
            all += found + "; ";
        }
        return all;
    }
    if (schema.contains("enum")) {
        for (const Json& each : schema["enum"]) {
            if (each == value) return "";
        }
        return path + " is none of the choices";
    }
    if (!has_type(value, schema.at("type"))) return path + " is no " + schema["type"].get<std::string>();
    if (schema.contains("minimum") && value < schema["minimum"]) return path + " is too small";
    if (schema.contains("maximum") && value > schema["maximum"]) return path + " is too large";
    if (schema.contains("minLength") && value.get<std::string>().empty()) return path + " is empty";
    if (schema.contains("pattern") &&
        !std::regex_search(value.get<std::string>(), std::regex(schema["pattern"].get<std::string>())))
        return path + " has another form";
    if (schema.contains("minItems") && value.size() < schema["minItems"]) return path + " is too short";
    if (schema.contains("maxItems") && value.size() > schema["maxItems"]) return path + " is too long";
    if (value.is_array()) {
        for (std::size_t i = 0; i < value.size(); ++i) {
            const std::string found = misfit(value[i], schema["items"], path + "[" + std::to_string(i) + "]");
            if (!found.empty()) return found;
        }
    }
    if (value.is_object()) {
        for (const auto& [key, inner] : value.items()) {
            if (!schema["properties"].contains(key)) return path + "." + key + " is unknown";
            const std::string found = misfit(inner, schema["properties"][key], path + "." + key);
            if (!found.empty()) return found;
        }
        const auto lacks = [&value = value](const Json& part) -> std::string {
            if (!part.contains("required")) return "";
            for (const Json& key : part["required"]) {
                if (!value.contains(key.get<std::string>())) return key.get<std::string>();
            }
            return "";
        };
        if (!lacks(schema).empty()) return path + " lacks " + lacks(schema);
        if (schema.contains("if") && !lacks(schema["if"]).empty() && !lacks(schema["else"]).empty())
            return path + " lacks " + lacks(schema["else"]);
    }
    return "";
}

std::string misfit(const std::string& yaml) {
    static const Json kSchema = Json::parse(config_schema());
    return misfit(json_of(YAML::Load(yaml)), kSchema, "config");
}

}  // namespace

TEST_CASE("the schema accepts all shipped configs, and the file shipped for editors is it") {
    int found = 0;
    for (const auto& entry : fs::directory_iterator(AUTOMORPH_CONFIGS)) {
        if (entry.path().extension() != ".yaml") continue;
        INFO(entry.path().string());
        CHECK(misfit(content(entry.path())) == "");
        ++found;
    }
    CHECK(found >= 10);
    // Made anew by: ./run config --schema > configs/schema.json
    CHECK(content(AUTOMORPH_CONFIGS "/schema.json") == config_schema());
}

TEST_CASE("every key of the table is in the schema, with its meaning") {
    const Json schema = Json::parse(config_schema());
    CHECK(schema["$schema"] == "http://json-schema.org/draft-07/schema#");
    for (const ConfigKey& key : config_keys()) {
        INFO(key.path);
        const Json* at = &schema;
        std::string rest = key.path;
        while (!rest.empty()) {
            std::string name = rest.substr(0, rest.find('.'));
            rest = name.size() < rest.size() ? rest.substr(name.size() + 1) : "";
            const bool list = name.size() > 2 && name.substr(name.size() - 2) == "[]";
            if (list) name.resize(name.size() - 2);
            if (at->contains("anyOf")) at = &(*at)["anyOf"][0];
            REQUIRE((*at)["properties"].contains(name));
            at = &(*at)["properties"][name];
            if (list) at = &(*at)["items"];
        }
        CHECK((*at)["description"].get<std::string>().rfind(key.meaning, 0) == 0);
    }
}

TEST_CASE("the schema refuses what the reader refuses") {
    const std::string shortest = "source: a.off\ntarget: b.off\nrows: [{label: one}]\n";
    CHECK(misfit(shortest) == "");
    CHECK(misfit(shortest + "alphas: [0, 1/3, 1]\n") == "");
    CHECK(misfit("target: b.off\n") == "config lacks source");
    CHECK(misfit("extends: other.yaml\ntarget: b.off\n") == "");  // it may have the source
    for (const char* wrong :
         {"target: b.off\n", "source: {file: a, colour: red}\n", "source: [a]\n",
          "source: a\npicture: {spp: 0}\n", "source: a\npicture: {spp: many}\n",
          "source: a\npicture: {view: [1, 2]}\n", "source: a\nshow: film\n", "source: a\nrows: []\n",
          "source: a\nrows: [{alignment: none}]\n", "source: a\nrows: [{label: x, lift: 3}]\n",
          "source: a\nalphas: [0, x]\n", "source: a\ntitle: []\n", "source: a\npictures: {}\n"}) {
        INFO(wrong);
        CHECK(misfit(wrong) != "");
        CHECK_THROWS(parse_config(wrong, "fig.yaml"));
    }
}
