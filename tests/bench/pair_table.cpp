#include "tests/bench/pair_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace automorph::bench {

namespace {

using Json = nlohmann::json;

constexpr int kLargeSide = 20000;      // triangles; above this a pair may take longer than
constexpr double kLongestWait = 30.0;  // CPU seconds

}  // namespace

std::string as_json(const PairCheck& check) {
    Json json = {{"route", check.route},
                 {"triangles", check.triangles},
                 {"flipped", check.flipped},
                 {"turned", check.turned},
                 {"missing", check.missing},
                 {"first", check.off_first},
                 {"last", check.off_last},
                 {"dense", check.dense},
                 {"p01", check.p01},
                 {"confident", check.confident},
                 {"seconds", check.seconds},
                 {"cpu_seconds", check.cpu_seconds},
                 {"slowest", ""}};
    double slowest = 0;
    for (const StageReport& stage : check.stages) {
        if (stage.seconds <= slowest) continue;
        slowest = stage.seconds;
        json["slowest"] = fmt::format("{} {:.1f}", stage.name, stage.seconds);
    }
    return json.dump();
}

void PairTable::print_head() {
    fmt::print(
        "| pair | triangles | route | merged | flips | turned | missing | p01 | off, % | s | CPU s | MB | "
        "slowest stage, s |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
}

void PairTable::print_row(const std::string& name, int source_triangles, int target_triangles,
                          const ChildResult& child) {
    ++pairs_;
    peak_memory_mb_ = std::max(peak_memory_mb_, child.peak_memory_mb);
    fmt::print("| {} | {} + {} |", name, source_triangles, target_triangles);
    if (!child.failure.empty()) {
        fmt::print(" FAILED: {} | {:.1f} s |\n", child.failure, child.seconds);
        failures_.push_back(name + ": " + child.failure);
        return;
    }
    const Json json = Json::parse(child.output);
    ++solved_;
    const std::string route = json["route"];
    const int flipped = json["flipped"], turned = json["turned"], missing = json["missing"];
    const double cpu_seconds = json["cpu_seconds"], first = json["first"], last = json["last"];
    const bool dense = json["dense"], confident = json["confident"];
    ++routes_[route];
    cpu_seconds_.push_back(cpu_seconds);
    unsure_ += !confident;
    without_dense_ += !dense;
    flipped_ += flipped;
    off_ = std::max({off_, first, last});
    if (flipped > 0 || turned > 0 || missing > 0)
        faults_.push_back(fmt::format("{}: {} flips, {} turned, {} missing", name, flipped, turned, missing));
    if (cpu_seconds > kLongestWait && std::max(source_triangles, target_triangles) <= kLargeSide) {
        ++slow_;
        faults_.push_back(fmt::format("{}: {:.1f} CPU seconds", name, cpu_seconds));
    }
    fmt::print(" {}{} | {} | {} | {} | {} | {:.2g} | {:.2g} {:.2g} | {:.1f} | {:.1f} | {:.0f} | {} |{}\n",
               route, dense ? "" : ", not dense", json["triangles"].get<int>(), flipped, turned, missing,
               json["p01"].get<double>(), first, last, json["seconds"].get<double>(), cpu_seconds,
               child.peak_memory_mb, json["slowest"].get<std::string>(), confident ? "" : " unsure");
    std::fflush(stdout);
}

void PairTable::print_summary() {
    fmt::print("\n{} of {} pairs solved:", solved_, pairs_);
    for (const auto& [route, count] : routes_) fmt::print(" {} {},", route, count);
    fmt::print(" {} without dense alignment; {} registrations unsure\n", without_dense_, unsure_);
    fmt::print("{} flips in maps; farthest from an input {:.2g} %\n", flipped_, off_);
    if (!cpu_seconds_.empty()) {
        std::sort(cpu_seconds_.begin(), cpu_seconds_.end());
        fmt::print(
            "CPU seconds: median {:.1f}, slowest {:.1f}; {} above {} of those up to {} triangles a side; "
            "peak memory {:.0f} MB\n",
            cpu_seconds_[cpu_seconds_.size() / 2], cpu_seconds_.back(), slow_, kLongestWait, kLargeSide,
            peak_memory_mb_);
    }
    fmt::print("{} pairs failed, {} faults\n", failures_.size(), faults_.size());
    for (const std::string& failure : failures_) fmt::print("failed: {}\n", failure);
    for (const std::string& fault : faults_) fmt::print("fault: {}\n", fault);
}

bool PairTable::flawless() const {
    return failures_.empty() && faults_.empty();
}

}  // namespace automorph::bench
