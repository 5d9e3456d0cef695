#include "tests/bench/limbs_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <utility>

#include "morph/mesh/geometry.h"
#include "morph/morph.h"
#include "tests/bench/pair_check.h"

namespace automorph::bench {

namespace {

const std::vector<std::pair<std::string, std::string>> kPairs = {
    {"homer", "man"},     {"cow", "bull"},
    {"cow", "pig"},       {"camel", "cow"},
    {"camel", "dino"},    {"armadillo", "homer"},
    {"armadillo", "man"}, {"bear", "camel"},
    {"hand", "cactus"},   {"triceratops", "cow"},
    {"pig", "bull"},      {"dino", "diplodocus"},
    {"bear", "bear_bis"}, {"ChineseDragon-10kv", "dino"}};

struct Run {
    Report report;
    std::vector<double> off;  ///< of matched tips, % of the target's diagonal
    double p01 = 1.0, cpu_seconds = 0.0;
};

/// How far from each target tip the matched tip of the source ends up, % of the target's diagonal.
std::vector<double> tips_off(const Morph& result, const InputMesh& source, const InputMesh& target,
                             const std::vector<std::pair<int, int>>& tips) {
    const Points correspondence = result.correspondence();
    const double diagonal = bounding_box_diagonal(target.mesh.V);
    std::vector<double> off;
    for (const auto& [a, b] : tips) {
        const auto row = std::find(source.vertex_of_file.begin(), source.vertex_of_file.end(), a) -
                         source.vertex_of_file.begin();
        off.push_back(100.0 * (correspondence.row(row) - target.mesh.V.row(b)).norm() / diagonal);
    }
    return off;
}

Run run(const InputMesh& source, const InputMesh& target, const MorphOptions& options,
        const std::vector<std::pair<int, int>>* tips) {
    const std::clock_t start = std::clock();
    const Morph result = morph(source, target, options);
    Run outcome{result.report(), {}};
    outcome.cpu_seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    for (const MapReport& map : outcome.report.maps) outcome.p01 = std::min(outcome.p01, map.p01);
    outcome.off = tips_off(result, source, target, tips ? *tips : outcome.report.alignment.limb_matches);
    return outcome;
}

std::string list(const std::vector<double>& numbers) {
    std::string text;
    for (const double number : numbers) text += fmt::format("{}{:.0f}", text.empty() ? "" : " ", number);
    return text.empty() ? "-" : text;
}

}  // namespace

int limbs_bench(const std::vector<std::string>& arguments) {
    std::vector<std::pair<std::string, std::string>> pairs = kPairs;
    if (!arguments.empty()) pairs.clear();
    for (std::size_t k = 0; k + 1 < arguments.size(); k += 2)
        pairs.emplace_back(arguments[k], arguments[k + 1]);
    fmt::print(
        "Tips of matched limbs off their partners, % of the target's diagonal\n\n| pair | limbs | matched | "
        "without "
        "| with | p01 without | with | late without | with | CPU s without | with |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const auto& [a, b] : pairs) {
        const auto file = [](const std::string& name) {
            return std::string(AUTOMORPH_DEMO_MESHES) + "/" + name + ".off";
        };
        const InputMesh source = load_mesh(file(a));
        const InputMesh target = admit_mesh(posed_at_random(load_mesh(file(b)).mesh, 7), b);
        MorphOptions without;
        without.nonrigid.limbs = 0.0;
        const Run with = run(source, target, {}, nullptr);
        const AlignmentReport& found = with.report.alignment;
        const Run plain = run(source, target, without, &found.limb_matches);
        fmt::print("| {} + {} | {} {} | {} | {} | {} | {:.3f} | {:.3f} | {} | {} | {:.1f} | {:.1f} |{}\n", a,
                   b, found.limbs_source, found.limbs_target, found.limb_matches.size(), list(plain.off),
                   list(with.off), plain.p01, with.p01, plain.report.alignment.moved, found.moved,
                   plain.cpu_seconds, with.cpu_seconds,
                   with.report.registration.confident ? "" : " registration unsure");
        std::fflush(stdout);
    }
    return 0;
}

}  // namespace automorph::bench
