#include "render/figure/config.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/eventhandler.h>

#include <fstream>
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

/// Refuses a second document. YAML::LoadAll must not see one: of some texts that begin indented it makes
/// documents without end.
class OneDocument : public YAML::EventHandler {
public:
    explicit OneDocument(const config::Place& place) : place_(place) {}

    void OnDocumentStart(const YAML::Mark& mark) override {
        if (++documents_ > 1) place_.fail(mark, "a second document ('---'); one config per file");
    }
    void OnDocumentEnd() override {}
    void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
    void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
    void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override {}
    void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                         YAML::EmitterStyle::value) override {}
    void OnSequenceEnd() override {}
    void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                    YAML::EmitterStyle::value) override {}
    void OnMapEnd() override {}

private:
    const config::Place& place_;
    int documents_ = 0;
};

/// The config's only document.
YAML::Node read_document(const std::string& text, const config::Place& place) {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    OneDocument only(place);
    while (parser.HandleNextDocument(only)) {
    }
    return YAML::Load(text);
}

}  // namespace

FigureConfig load_config(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream || std::filesystem::is_directory(file)) {
        throw IoError(fmt::format("{}: cannot read this config; is the path right?", file.string()));
    }
    return parse_config({std::istreambuf_iterator<char>(stream), {}}, file);
}

FigureConfig parse_config(const std::string& text, const std::filesystem::path& file) {
    const config::Place place{file.string(), ""};
    FigureConfig figure;
    figure.file = file;
    figure.text = text;
    figure.output = std::filesystem::path("out") / file.stem();
    try {
        const YAML::Node top = read_document(text, place);
        if (top.IsNull()) {
            throw ConfigError(file.string() +
                              ":1:1: found nothing, expected a config ('automorph config --explain')");
        }
        config::read_section(figure, top, config::figure_section(), place);
    } catch (const YAML::Exception& error) {
        // Syntax errors, and whatever else yaml-cpp objects to.
        place.fail(error.mark, error.msg);
    }
    return figure;
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
        "A figure's config is a YAML file. Relative paths are relative to the config's folder.\n"
        "Numbers may be fractions (1/3). Unknown keys are errors.\n\n";
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
