#include "tests/bench/pairs_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>
#include <stdexcept>

#include "morph/mesh/errors.h"
#include "morph/mesh/io.h"
#include "morph/morph.h"
#include "tests/bench/child_process.h"
#include "tests/bench/number.h"
#include "tests/bench/pair_check.h"

namespace automorph::bench {

namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr int kLargeSide = 20000;      // triangles; above this a pair may take longer than
constexpr double kLongestWait = 30.0;  // seconds

struct Arguments {
    std::vector<std::string> folders{AUTOMORPH_DEMO_MESHES};
    int sample = 150;
    bool all = false;
    std::uint64_t seed = 1;
    std::string only;
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
    bool large() const { return std::max(source.triangles, target.triangles) > kLargeSide; }
};

/// Does the pair's name, in either order, contain the text?
bool is_named(const Pair& pair, const std::string& text) {
    const std::string back = pair.target.name() + " + " + pair.source.name();
    return pair.name().find(text) != std::string::npos || back.find(text) != std::string::npos;
}

/// All pairs, or a sample with equal shares of closed, open and mixed ones.
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
    return chosen;
}

std::string check_as_json(const Pair& pair, const MorphOptions& options) {
    const InputMesh source = load_mesh(pair.source.file);
    const InputMesh target =
        admit_mesh(posed_at_random(load_mesh(pair.target.file).mesh, pair.seed), pair.target.file);
    const PairCheck check = check_pair(source, target, options);
    Json json = {{"route", check.route},         {"triangles", check.triangles}, {"flipped", check.flipped},
                 {"turned", check.turned},       {"missing", check.missing},     {"first", check.off_first},
                 {"last", check.off_last},       {"dense", check.dense},         {"p01", check.p01},
                 {"confident", check.confident}, {"seconds", check.seconds},     {"slowest", ""}};
    double slowest = 0;
    for (const StageReport& stage : check.stages) {
        if (stage.seconds <= slowest) continue;
        slowest = stage.seconds;
        json["slowest"] = fmt::format("{} {:.1f}", stage.name, stage.seconds);
    }
    return json.dump();
}

struct Summary {
    int pairs = 0, solved = 0, slow = 0, unsure = 0, without_dense = 0;
    int flipped = 0, turned_pairs = 0, missing_pairs = 0;
    double off = 0, peak_memory_mb = 0;
    std::map<std::string, int> routes;
    std::vector<double> seconds;
    std::vector<std::string> failures;
};

void print_row(const Pair& pair, const ChildResult& child, Summary& summary) {
    ++summary.pairs;
    summary.peak_memory_mb = std::max(summary.peak_memory_mb, child.peak_memory_mb);
    fmt::print("| {} | {} + {} |", pair.name(), pair.source.triangles, pair.target.triangles);
    if (!child.failure.empty()) {
        fmt::print(" FAILED: {} | {:.1f} s |\n", child.failure, child.seconds);
        summary.failures.push_back(pair.name() + ": " + child.failure);
        return;
    }
    const Json json = Json::parse(child.output);
    ++summary.solved;
    const std::string route = json["route"];
    const double seconds = json["seconds"], first = json["first"], last = json["last"];
    ++summary.routes[route];
    summary.seconds.push_back(seconds);
    summary.slow += seconds > kLongestWait && !pair.large();
    summary.unsure += !json["confident"].get<bool>();
    summary.without_dense += !json["dense"].get<bool>();
    summary.flipped += json["flipped"].get<int>();
    summary.turned_pairs += json["turned"].get<int>() > 0;
    summary.missing_pairs += json["missing"].get<int>() > 0;
    summary.off = std::max({summary.off, first, last});
    fmt::print(" {}{} | {} | {} | {} | {} | {:.2g} | {:.2g} {:.2g} | {:.1f} | {:.1f} | {:.0f} | {} |{}\n",
               route, json["dense"].get<bool>() ? "" : ", not dense", json["triangles"].get<int>(),
               json["flipped"].get<int>(), json["turned"].get<int>(), json["missing"].get<int>(),
               json["p01"].get<double>(), first, last, seconds, child.cpu_seconds, child.peak_memory_mb,
               json["slowest"].get<std::string>(), json["confident"].get<bool>() ? "" : " unsure");
}

void print_summary(Summary& summary) {
    fmt::print("\n{} of {} pairs solved:", summary.solved, summary.pairs);
    for (const auto& [route, count] : summary.routes) fmt::print(" {} {},", route, count);
    fmt::print(" {} without dense alignment; {} registrations unsure\n", summary.without_dense,
               summary.unsure);
    fmt::print(
        "{} flips in maps; {} pairs with turned merged triangles; {} pairs that lack input vertices; "
        "farthest from an input {:.2g} %\n",
        summary.flipped, summary.turned_pairs, summary.missing_pairs, summary.off);
    if (!summary.seconds.empty()) {
        std::sort(summary.seconds.begin(), summary.seconds.end());
        fmt::print(
            "seconds: median {:.1f}, slowest {:.1f}; {} above {} s of those up to {} triangles a side; "
            "peak memory {:.0f} MB\n",
            summary.seconds[summary.seconds.size() / 2], summary.seconds.back(), summary.slow, kLongestWait,
            kLargeSide, summary.peak_memory_mb);
    }
    for (const std::string& failure : summary.failures) fmt::print("failed: {}\n", failure);
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
    fmt::print(
        "| pair | triangles | route | merged | flips | turned | missing | p01 | off, % | s | CPU s | MB | "
        "slowest stage, s |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    Summary summary;
    for (const Pair& pair : pairs(meshes, arguments)) {
        const ChildResult child =
            run_in_child([&] { return check_as_json(pair, arguments.options); }, arguments.limits);
        print_row(pair, child, summary);
        std::fflush(stdout);
    }
    print_summary(summary);
    return summary.solved == summary.pairs && summary.flipped == 0 && summary.missing_pairs == 0 ? 0 : 1;
}

}  // namespace automorph::bench
