#include "tests/bench/power_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include "morph/mesh/errors.h"
#include "render/compare/difference.h"
#include "render/compare/same_seed.h"
#include "tests/bench/golden_scene.h"
#include "tests/bench/number.h"
#include "tests/render/figure/golden.h"

namespace automorph::bench {
namespace {

using power::Change;
using render::NoisyImage;

constexpr double kStatedShare = 0.01;  // of pairs without a change that may be rejected
constexpr std::array<Change, 5> kListed{Change::Light, Change::Albedo, Change::Normal, Change::Ring,
                                        Change::Camera};

struct Arguments {
    int pairs = 100;
    int limit = 1024;  // samples per pixel
    std::vector<std::string> figures;
};

Arguments parse(const std::vector<std::string>& words) {
    Arguments arguments;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i] == "--pairs" || words[i] == "--limit") {
            int& number = words[i] == "--pairs" ? arguments.pairs : arguments.limit;
            number = number_of(words[i], i + 1 < words.size() ? words[i + 1] : "", 1);
            ++i;
        } else if (std::count(golden::names().begin(), golden::names().end(), words[i]) == 0) {
            throw ConfigError(fmt::format("{}: no golden figure; there are {}", words[i],
                                          fmt::join(golden::names(), ", ")));
        } else {
            arguments.figures.push_back(words[i]);
        }
    }
    if (arguments.figures.empty()) arguments.figures = golden::names();
    return arguments;
}

/// The most of `pairs` pairs that may be rejected: more have a probability below 1 % at the stated share.
int most_rejected(int pairs) {
    constexpr double kSurprise = 0.01;
    double none_or_fewer = 0.0;
    for (int k = 0; k < pairs; ++k) {
        const double ways = std::lgamma(pairs + 1.0) - std::lgamma(k + 1.0) - std::lgamma(pairs - k + 1.0);
        none_or_fewer +=
            std::exp(ways + k * std::log(kStatedShare) + (pairs - k) * std::log1p(-kStatedShare));
        if (1.0 - none_or_fewer < kSurprise) return k;
    }
    return pairs;
}

/// Each change with seeds of its own against pictures of the golden with as many samples.
class ChangeHunt {
public:
    ChangeHunt(const GoldenScene& scene, int limit) : scene_(scene), limit_(limit) {}

    struct Catch {
        int spp = 0;  // with which it is caught; 0: missed
        std::string test;
    };

    /// With the golden's samples, then twice as many and so on.
    Catch find(Change change) {
        const std::uint64_t seed = scene_.picture.seed + 1 + static_cast<std::uint64_t>(change);
        for (int spp = scene_.spp; spp <= std::max(limit_, scene_.spp); spp *= 2) {
            const auto comparison = render::compare_statistical(
                golden(spp), render_changed(scene_, change, spp, seed), {kStatedShare});
            if (!comparison.same()) return {spp, comparison.worst().name};
        }
        return {};
    }

    /// Whether the comparison that golden_test makes, with the golden's own seed and samples, sees it.
    bool seen_with_same_seed(Change change) {
        const NoisyImage changed = render_changed(scene_, change, scene_.spp, scene_.picture.seed);
        return !render::compare_same_seed(golden(scene_.spp).image, changed.image).same();
    }

    /// Of a pixel, in radiance, between pictures of one seed, with the most samples that were tried.
    /// @pre find() has tried some
    double largest_change(Change change) {
        const auto& [spp, golden] = *goldens_.rbegin();
        const NoisyImage changed = render_changed(scene_, change, spp, scene_.picture.seed);
        return render::compare(golden.image, changed.image).max_pixel;
    }

private:
    const NoisyImage& golden(int spp) {
        const auto found = goldens_.find(spp);
        if (found != goldens_.end()) return found->second;
        return goldens_.emplace(spp, render_changed(scene_, Change::None, spp, scene_.picture.seed))
            .first->second;
    }

    const GoldenScene& scene_;
    int limit_;
    std::map<int, NoisyImage> goldens_;
};

/// Rejected pairs of pictures that differ in nothing but the seed, each picture with the one before.
int rejected_pairs(const GoldenScene& scene, int pairs) {
    constexpr std::uint64_t kFirst = 1000;
    int rejected = 0;
    NoisyImage before = render_changed(scene, Change::None, scene.spp, kFirst);
    for (int pair = 1; pair <= pairs; ++pair) {
        NoisyImage next =
            render_changed(scene, Change::None, scene.spp, kFirst + static_cast<std::uint64_t>(pair));
        rejected += !render::compare_statistical(before, next, {kStatedShare}).same();
        before = std::move(next);
    }
    return rejected;
}

struct Totals {
    int changes = 0, by_noise = 0, by_seed = 0, missed = 0;
    int pairs = 0, rejected = 0, noisy_scenes = 0;
};

void add_row(const GoldenScene& scene, const Arguments& arguments, Totals& totals) {
    fmt::print("| {} | {} x {}, {} |", scene.name, scene.width, scene.height, scene.spp);
    ChangeHunt hunt(scene, arguments.limit);
    for (const Change change : kListed) {
        if (change == Change::Normal && !scene.smooth()) {
            fmt::print(" flat |");
            continue;
        }
        const ChangeHunt::Catch found = hunt.find(change);
        const bool by_noise = found.spp == scene.spp, by_seed = hunt.seen_with_same_seed(change);
        ++totals.changes;
        totals.by_noise += by_noise;
        totals.by_seed += by_seed;
        totals.missed += !by_noise && !by_seed;
        if (found.spp == 0)
            fmt::print(" **not with {}**: {:.4f}", arguments.limit, hunt.largest_change(change));
        else
            fmt::print(" {}{}, {}", by_noise ? "" : "not; ", found.spp, found.test);
        fmt::print("; {} |", by_seed ? "seed" : "**seed not**");
        std::fflush(stdout);
    }
    const int rejected = rejected_pairs(scene, arguments.pairs);
    totals.pairs += arguments.pairs;
    totals.rejected += rejected;
    totals.noisy_scenes += rejected > most_rejected(arguments.pairs);
    fmt::print(" {:.1f} | {} of {} |\n", scene.ring_area, rejected, arguments.pairs);
    std::fflush(stdout);
}

}  // namespace

int power_bench(const std::vector<std::string>& words) {
    const Arguments arguments = parse(words);
    fmt::print(
        "Samples per pixel with which changes of golden cells are caught by noise, and by which test. "
        "\"not\": "
        "not with the golden's own; if in bold: by how much a pixel's radiance changes at most. \"seed\": "
        "caught with the golden's own seed and samples, as golden_test compares.\n\n"
        "| golden | pixels, samples |");
    for (const Change change : kListed) fmt::print(" {} |", power::name(change));
    fmt::print(" ring, pixels | pairs of seeds rejected |\n|---|---|---|---|---|---|---|---|---|\n");
    Totals totals;
    for (const std::string& figure : arguments.figures) {
        const std::vector<GoldenScene> scenes = golden_scenes(figure);
        if (scenes.empty()) std::fprintf(stderr, "%s is drawn, not path-traced: left out\n", figure.c_str());
        for (const GoldenScene& scene : scenes) add_row(scene, arguments, totals);
    }
    fmt::print(
        "\nOf {} changes, with the golden's own samples {} are caught by noise, {} with the same seed, {} by "
        "neither.\n",
        totals.changes, totals.by_noise, totals.by_seed, totals.missed);
    fmt::print("{} of {} pairs of seeds are rejected; stated share {:g} %, at most {} of {} for a golden.\n",
               totals.rejected, totals.pairs, 100.0 * kStatedShare, most_rejected(arguments.pairs),
               arguments.pairs);
    return totals.missed > 0 || totals.noisy_scenes > 0 ? 1 : 0;
}

}  // namespace automorph::bench
