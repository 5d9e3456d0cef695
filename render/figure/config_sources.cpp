#include "render/figure/config_sources.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <utility>

#include "morph/mesh/errors.h"
#include "render/figure/config_reader.h"

namespace automorph::config {
namespace {

namespace fs = std::filesystem;

/// Refuses a second document. YAML::LoadAll must not see one: of some texts that begin indented it makes
/// documents without end.
class OneDocument : public YAML::EventHandler {
public:
    explicit OneDocument(const Place& place) : place_(place) {}

    void OnDocumentStart(const YAML::Mark& mark) override {
        if (++documents_ > 1) place_.fail(mark, "a second document ('---'); one config per file");
    }
    void OnDocumentEnd() override {}
    void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
    void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { alias_ = mark; }
    void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override {}
    void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                         YAML::EmitterStyle::value) override {}
    void OnSequenceEnd() override {}
    void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                    YAML::EmitterStyle::value) override {}
    void OnMapEnd() override {}

    /// One of the aliases, if there are any.
    const std::optional<YAML::Mark>& alias() const { return alias_; }

private:
    const Place& place_;
    int documents_ = 0;
    std::optional<YAML::Mark> alias_;
};

struct Document {
    YAML::Node top;
    std::optional<YAML::Mark> alias;  ///< where one stands, if any does
};

/// The config's only document.
Document read_document(const std::string& text, const Place& place) {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    OneDocument only(place);
    while (parser.HandleNextDocument(only)) {
    }
    return {YAML::Load(text), only.alias()};
}

/// Puts the keys into `node` that only `base` has, so that all keep their marks; mappings that both have are
/// merged.
void merge(YAML::Node node, const YAML::Node& base, const Place& place) {
    std::vector<std::string> seen;
    for (const auto& entry : base) {
        const std::string name = entry.first.IsScalar() ? entry.first.Scalar() : "";
        if (std::find(seen.begin(), seen.end(), name) != seen.end())
            place.fail(entry.first.Mark(), fmt::format("'{}' is given twice", name));
        seen.push_back(name);
        if (name == "extends") continue;
        const YAML::Node own = std::as_const(node)[name];
        if (!own) {
            node[entry.first] = entry.second;
        } else if (own.IsMap() && entry.second.IsMap()) {
            merge(own, entry.second, place);
        }
    }
}

/// Reads a chain of configs, each extended by the one before.
class Chain {
public:
    Chain(Sources& sources, std::vector<ConfigText>& bases) : sources_(sources), bases_(bases) {}

    YAML::Node read(const std::string& text, const fs::path& file) {
        const Place place{sources_};
        const Document document =
            read_document(sources_.add(file.string(), file.parent_path(), true, text), place);
        const YAML::Node node = document.top;
        if (node.IsNull()) {
            throw ConfigError(file.string() +
                              ":1:1: found nothing, expected a config ('automorph config --explain')");
        }
        files_.push_back(file);
        const YAML::Node extends = node.IsMap() ? node["extends"] : YAML::Node(YAML::NodeType::Undefined);
        if (!extends || !extends.IsScalar() || extends.Scalar().empty())
            return node;  // the table says what is wrong
        const fs::path base = (file.parent_path() / extends.Scalar()).lexically_normal();
        check_cycle(base, extends.Mark(), place);
        const YAML::Node below = read(base_text(base, extends.Mark(), place), base);
        if (!below.IsMap())
            place.fail(extends.Mark(), fmt::format("extends: {} is no mapping", base.string()));
        // What an alias stands for is one mapping in several places; merging would change all of them.
        if (document.alias)
            place.fail(*document.alias, "an alias in a config that extends another; write it out");
        merge(node, below, place);
        return node;
    }

private:
    void check_cycle(const fs::path& base, const YAML::Mark& mark, const Place& place) const {
        std::error_code ignored;
        const bool cycle = std::any_of(files_.begin(), files_.end(), [&](const fs::path& each) {
            return each.lexically_normal() == base || fs::equivalent(each, base, ignored);
        });
        if (!cycle) return;
        std::string way;
        for (const fs::path& each : files_) way += each.filename().string() + " -> ";
        place.fail(
            mark, fmt::format("extends: a config cannot extend itself: {}{}", way, base.filename().string()));
    }

    std::string base_text(const fs::path& base, const YAML::Mark& mark, const Place& place) {
        std::string text;
        std::error_code ignored;
        // A pipe or device might never end.
        if (fs::exists(base, ignored) && !fs::is_regular_file(base, ignored))
            place.fail(mark, fmt::format("extends: {} is no file", base.string()));
        try {
            text = read_config_text(base);
        } catch (const IoError& error) {
            place.fail(mark, fmt::format("extends: {}", error.what()));
        }
        bases_.push_back({base, text});
        constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // allowed at the very beginning only
        if (text.rfind(kByteOrderMark, 0) == 0) text.erase(0, kByteOrderMark.size());
        return text;
    }

    Sources& sources_;
    std::vector<ConfigText>& bases_;
    std::vector<fs::path> files_;
};

/// "rows[0].label" as {"rows", "[0]", "label"}; empty if it is no such path.
std::vector<std::string> steps_of(const std::string& path) {
    std::vector<std::string> steps;
    for (std::size_t begin = 0; begin < path.size();) {
        const bool index = path[begin] == '[';
        std::size_t end = index ? path.find(']', begin) : path.find_first_of(".[", begin);
        if (index && end == std::string::npos) return {};
        end = index ? end + 1 : std::min(end, path.size());
        if (end == begin) return {};
        steps.push_back(path.substr(begin, end - begin));
        if (end < path.size() && path[end] == '.') {
            if (++end == path.size()) return {};
        } else if (end < path.size() && path[end] != '[') {
            return {};
        }
        begin = end;
    }
    return steps;
}

}  // namespace

std::string Sources::add(const std::string& name, const fs::path& folder, bool has_lines,
                         const std::string& text) {
    const int first = next_line_;
    sources_.push_back({name, folder, has_lines, first});
    // Marks of what is missing at the end lie a line below.
    next_line_ += static_cast<int>(std::count(text.begin(), text.end(), '\n')) + 2;
    return std::string(static_cast<std::size_t>(first), '\n') + text;
}

const Sources::Source& Sources::source_of(const YAML::Mark& mark) const {
    const auto after =
        std::upper_bound(sources_.begin(), sources_.end(), mark.line,
                         [](int line, const Source& source) { return line < source.first_line; });
    return after == sources_.begin() ? sources_.front() : *std::prev(after);
}

std::string Sources::where(const YAML::Mark& mark) const {
    const Source& source = source_of(mark);
    if (!source.has_lines || mark.is_null()) return source.name;
    return fmt::format("{}:{}:{}", source.name, mark.line - source.first_line + 1, mark.column + 1);
}

fs::path Sources::folder_of(const YAML::Mark& mark) const {
    return source_of(mark).folder;
}

std::string read_config_text(const fs::path& file) {
    const auto fail = [&](const std::string& reason) {
        throw IoError(fmt::format("{}: this config cannot be read: {}", file.string(), reason));
    };
    std::error_code ignored;
    if (fs::is_directory(file, ignored)) fail("it is a folder");
    errno = 0;
    std::ifstream stream(file, std::ios::binary);
    if (!stream) fail(std::strerror(errno));
    return {std::istreambuf_iterator<char>(stream), {}};
}

YAML::Node read_documents(Sources& sources, const std::string& text, const fs::path& file,
                          std::vector<ConfigText>& bases) {
    return Chain(sources, bases).read(text, file);
}

void apply_override(Sources& sources, const YAML::Node& top, const std::string& text) {
    const std::string option = "--set " + text;
    const auto fail = [&](const std::string& why) { throw ConfigError(fmt::format("{}: {}", option, why)); };
    const std::size_t equals = text.find('=');
    const std::vector<std::string> steps = steps_of(text.substr(0, equals));
    if (equals == std::string::npos || steps.empty() || steps.front().front() == '[')
        fail("expected KEY=VALUE with the key's path, e.g. picture.spp=16 or rows[0].domain=disk");
    if (steps.front() == "extends") fail("it has been followed by now; give a config that extends the other");
    if (text.find_first_not_of(' ', equals + 1) == std::string::npos) fail("there is no value");
    // Parsed as texts of their own, so that errors find them.
    const auto parsed = [&](const std::string& part) {
        return YAML::Load(sources.add(option, {}, false, part));
    };

    YAML::Node node = top;
    std::string way;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const bool last = i + 1 == steps.size();
        const std::string& step = steps[i];
        if (step.front() == '[') {
            std::size_t index = 0;
            const auto [end, error] = std::from_chars(step.data() + 1, step.data() + step.size() - 1, index);
            if (error != std::errc{} || end != step.data() + step.size() - 1) fail(step + " is no index");
            if (!node.IsSequence() || index >= node.size()) {
                fail(fmt::format("there is no {}{}; {}", way, step,
                                 node.IsSequence() ? fmt::format("it has {}, counted from 0", node.size())
                                                   : "it is no list"));
            }
            if (last) node[index] = parsed(text.substr(equals + 1));
            node.reset(YAML::Node(node[index]));
        } else {
            if (!node.IsMap()) fail(fmt::format("{} is no mapping here", way.empty() ? "the config" : way));
            const bool exists = static_cast<bool>(std::as_const(node)[step]);
            if (last || !exists) {
                node.remove(step);  // name and all: errors about it tell of the override, not of the file
                node[parsed(step)] = parsed(last ? text.substr(equals + 1) : "{}");
            }
            node.reset(YAML::Node(node[step]));
        }
        way += (way.empty() || step.front() == '[' ? "" : ".") + step;
    }
}

}  // namespace automorph::config
