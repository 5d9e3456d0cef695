#include "tests/bench/pairs_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <stdexcept>

#include "morph/mesh/errors.h"
#include "morph/mesh/io.h"
#include "morph/morph.h"
#include "tests/bench/child_process.h"
#include "tests/bench/number.h"
#include "tests/bench/pair_check.h"
#include "tests/bench/pair_log.h"
#include "tests/bench/pair_table.h"

namespace automorph::bench {

namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

struct Arguments {
    std::vector<std::string> folders{AUTOMORPH_DEMO_MESHES};
    int sample = 150;
    bool all = false;
    std::uint64_t seed = 1;
    std::string only, log;
    std::size_t shard = 1, shards = 1;
    ChildLimits limits;
    MorphOptions options;
};

Arguments parsed(const std::vector<std::string>& words) {
    Arguments arguments;
    for (std::size_t k = 0; k < words.size(); ++k) {
        const std::string& word = words[k];
        const auto value = [&]() -> const std::string& {
            if (k + 1 == words.size()) throw std::invalid_argument(word + " wants a value");
            return words[++k];
        };
        if (word == "--all") {
            arguments.all = true;
        } else if (word == "--sample") {
            arguments.sample = number_of(word, value(), 1);
        } else if (word == "--seed") {
            arguments.seed = number_of<std::uint64_t>(word, value(), 0);
        } else if (word == "--only") {
            arguments.only = value();
        } else if (word == "--log") {
            arguments.log = value();
        } else if (word == "--shard") {
            const std::string& shard = value();
            if (std::sscanf(shard.c_str(), "%zu/%zu", &arguments.shard, &arguments.shards) != 2 ||
                arguments.shard < 1 || arguments.shard > arguments.shards)
                throw std::invalid_argument("--shard wants I/N, as 1/4, and not " + shard);
        } else if (word == "--seconds") {
            arguments.limits.seconds = number_of(word, value(), 0.0);
        } else if (word == "--memory") {
            arguments.limits.memory_gb = number_of(word, value(), 0.0);
        } else if (word == "--flat") {
            arguments.options.lift = false;
        } else if (word == "--registration") {
            arguments.options.alignment = Alignment::Registration;
        } else if (fs::is_directory(word)) {
            arguments.folders.push_back(word);
        } else {
            throw std::invalid_argument(fmt::format("'{}' is no folder and no option", word));
        }
    }
    return arguments;
}

struct Candidate {
    std::string file;
    bool closed = false;
    int triangles = 0;
    std::string name() const { return fs::path(file).stem().string(); }
};

/// The admissible meshes of the folders: .off of the example meshes, any format elsewhere.
std::vector<Candidate> candidates(const Arguments& arguments) {
    std::vector<Candidate> found;
    for (const std::string& folder : arguments.folders) {
        std::vector<std::string> files;
        for (const auto& entry : fs::directory_iterator(folder)) {
            const fs::path& path = entry.path();
            const bool demo = folder == AUTOMORPH_DEMO_MESHES;
            if (demo ? path.extension() == ".off" : is_mesh_file(path)) files.push_back(path.string());
        }
        std::sort(files.begin(), files.end());
        for (const std::string& file : files) {
            const ChildResult child = run_in_child(
                [&] {
                    try {
                        const InputMesh input = load_mesh(file);
                        return Json{{"closed", input.report.closed}, {"triangles", input.report.triangles}}
                            .dump();
                    } catch (const Error&) {
                        return std::string("{}");  // refused, and says why
                    }
                },
                arguments.limits);
            if (!child.failure.empty()) {
                fmt::print("{}: {}\n", file, child.failure);
                continue;
            }
            const Json json = Json::parse(child.output);
            if (json.empty()) continue;
            found.push_back({file, json["closed"], json["triangles"]});
        }
    }
    return found;
}

struct Pair {
    Candidate source, target;
    std::uint64_t seed = 1;
    std::string name() const { return source.name() + " + " + target.name(); }
    /// What tells it from others in a log.
    std::string key(const MorphOptions& options) const {
        return fmt::format("{} + {}, seed {}{}{}", source.file, target.file, seed,
                           options.lift ? "" : ", flat",
                           options.alignment == Alignment::Registration ? ", registration" : "");
    }
};

/// Does the pair's name, in either order, contain the text?
bool is_named(const Pair& pair, const std::string& text) {
    const std::string back = pair.target.name() + " + " + pair.source.name();
    return pair.name().find(text) != std::string::npos || back.find(text) != std::string::npos;
}

/// All pairs, or a sample with equal shares of closed, open and mixed ones; of these, every N-th where
/// --shard says.
std::vector<Pair> pairs(const std::vector<Candidate>& meshes, const Arguments& arguments) {
    std::array<std::vector<Pair>, 3> kinds;
    std::mt19937_64 random(arguments.seed);
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        for (std::size_t j = i + 1; j < meshes.size(); ++j) {
            const bool back = random() % 2 == 0;
            Pair pair{meshes[back ? j : i], meshes[back ? i : j], random()};
            if (!is_named(pair, arguments.only)) continue;
            kinds[static_cast<std::size_t>(pair.source.closed) + pair.target.closed].push_back(pair);
        }
    }
    std::vector<Pair> chosen;
    for (auto& kind : kinds) {
        if (!arguments.all) {
            for (std::size_t k = kind.size(); k > 1; --k) std::swap(kind[k - 1], kind[random() % k]);
            const auto share = static_cast<std::size_t>((arguments.sample + 2) / 3);
            if (kind.size() > share) kind.resize(share);
        }
        chosen.insert(chosen.end(), kind.begin(), kind.end());
    }
    std::vector<Pair> own;
    for (std::size_t k = arguments.shard - 1; k < chosen.size(); k += arguments.shards)
        own.push_back(chosen[k]);
    return own;
}

std::string checked(const Pair& pair, const MorphOptions& options) {
    const InputMesh source = load_mesh(pair.source.file);
    const InputMesh target =
        admit_mesh(posed_at_random(load_mesh(pair.target.file).mesh, pair.seed), pair.target.file);
    return as_json(check_pair(source, target, options));
}

}  // namespace

int pairs_bench(const std::vector<std::string>& words) {
    Arguments arguments;
    try {
        arguments = parsed(words);
    } catch (const std::exception& error) {
        fmt::print(stderr, "pairs: {}\n", error.what());
        return 2;
    }
    const std::vector<Candidate> meshes = candidates(arguments);
    const auto closed = std::count_if(meshes.begin(), meshes.end(), [](const auto& m) { return m.closed; });
    fmt::print("{} closed and {} open meshes\n\n", closed, static_cast<long>(meshes.size()) - closed);
    PairTable table;
    table.print_head();
    PairLog log(arguments.log);
    for (const Pair& pair : pairs(meshes, arguments)) {
        const std::string key = pair.key(arguments.options);
        std::optional<ChildResult> child = log.find(key);
        if (!child) {
            child = run_in_child([&] { return checked(pair, arguments.options); }, arguments.limits);
            log.add(key, *child);
        }
        table.print_row(pair.name(), pair.source.triangles, pair.target.triangles, *child);
    }
    table.print_summary();
    return table.flawless() ? 0 : 1;
}

}  // namespace automorph::bench
