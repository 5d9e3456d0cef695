#include "tests/bench/accuracy_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <map>

#include "morph/morph.h"
#include "tests/bench/accuracy_pairs.h"

namespace automorph::bench {

namespace {

struct Outcome {
    AccuracyScore score;
    double seconds = 0;
    int flipped = 0;
    bool followed = false;
};

Outcome run(const AccuracyPair& pair, const MorphOptions& options) {
    const InputMesh source = admit_mesh(pair.source), target = admit_mesh(pair.target);
    const auto start = std::chrono::steady_clock::now();
    const Morph result = morph(source, target, options);
    Outcome outcome;
    outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    outcome.score = score(pair, result.correspondence());
    for (const MapReport& map : result.report().maps) outcome.flipped += map.flipped;
    outcome.followed = result.report().alignment.used;
    return outcome;
}

/// Mean over groups of pairs, in the order in which groups first appear.
class Groups {
public:
    void add(const std::string& group, const Outcome& outcome) {
        if (sums_.find(group) == sums_.end()) order_.push_back(group);
        Sum& sum = sums_[group];
        sum.mean += outcome.score.mean;
        sum.p95 += outcome.score.p95;
        ++sum.count;
    }
    const std::vector<std::string>& order() const { return order_; }
    std::string cell(const std::string& group) const {
        const Sum& sum = sums_.at(group);
        return fmt::format("{:.2f} / {:.2f}", sum.mean / sum.count, sum.p95 / sum.count);
    }

private:
    struct Sum {
        double mean = 0, p95 = 0;
        int count = 0;
    };
    std::map<std::string, Sum> sums_;
    std::vector<std::string> order_;
};

struct Variant {
    std::string name;
    std::function<void(MorphOptions&)> change;
    bool paper_domain = false;  ///< the paper's: the disk, or a cut of closed shapes
};

const std::vector<Variant> kMethods = {
    {"paper: registration", [](MorphOptions& o) { o.alignment = Alignment::Registration; }, true},
    {"paper: registration + curvature", [](MorphOptions& o) { o.alignment = Alignment::Features; }, true},
    {"registration, sphere where the disk is bad",
     [](MorphOptions& o) { o.alignment = Alignment::Registration; }},
    {"dense", [](MorphOptions&) {}},
};

const std::vector<Variant> kAblations = {
    {"without normals", [](MorphOptions& o) { o.nonrigid.normals = false; }},
    {"without bending", [](MorphOptions& o) { o.nonrigid.bending = 0; }},
    {"without membrane", [](MorphOptions& o) { o.nonrigid.membrane = 0; }},
    {"without directional trust", [](MorphOptions& o) { o.nonrigid.directional_trust = false; }},
    {"without the pull of borders", [](MorphOptions& o) { o.nonrigid.border = 0; }},
    {"borders do not slide", [](MorphOptions& o) { o.nonrigid.slide = 0; }},
    {"elastic, not plastic", [](MorphOptions& o) { o.nonrigid.plastic = 0; }},
    {"without the similarity", [](MorphOptions& o) { o.nonrigid.similarity_rounds = 0; }},
    {"all levels at full resolution", [](MorphOptions& o) { o.nonrigid.coarse_levels = 0; }},
    {"2 rounds a level", [](MorphOptions& o) { o.nonrigid.rounds = 2; }},
};

void print_table(const std::vector<Variant>& variants, const std::vector<AccuracyPair>& pairs) {
    bool first = true;
    for (const Variant& variant : variants) {
        MorphOptions options;
        variant.change(options);
        Groups groups;
        double slowest = 0;
        int flipped = 0, left = 0;
        for (const AccuracyPair& pair : pairs) {
            if (variant.paper_domain) {
                const bool closed = admit_mesh(pair.source).report.closed;
                options.domain = closed ? Domain::Cut : Domain::Disk;
            }
            const Outcome outcome = run(pair, options);
            groups.add(pair.group, outcome);
            slowest = std::max(slowest, outcome.seconds);
            flipped += outcome.flipped;
            left += options.alignment == Alignment::Dense && !outcome.followed;
        }
        if (first) {
            fmt::print("| mean / 95th percentile, % of the diagonal |");
            for (const std::string& group : groups.order()) fmt::print(" {} |", group);
            fmt::print(" flips | slowest, s |\n|---|");
            for (std::size_t k = 0; k < groups.order().size() + 2; ++k) fmt::print("---|");
            fmt::print("\n");
            first = false;
        }
        fmt::print("| {} |", variant.name);
        for (const std::string& group : groups.order()) fmt::print(" {} |", groups.cell(group));
        fmt::print(" {} | {:.1f} |{}\n", flipped, slowest,
                   left > 0 ? fmt::format(" given up on {} pairs", left) : "");
        std::fflush(stdout);
    }
}

}  // namespace

int accuracy_bench(const std::vector<std::string>& arguments) {
    std::string folder = "../shared/meshes";
    bool ablation = false;
    std::vector<std::string> named;  // variants; none: all
    for (std::size_t k = 0; k < arguments.size(); ++k) {
        if (arguments[k] == "--ablation") {
            ablation = true;
        } else if (arguments[k] == "--only" && k + 1 < arguments.size()) {
            named.push_back(arguments[++k]);
        } else {
            folder = arguments[k];
        }
    }
    std::vector<Variant> methods = kMethods, ablations = kAblations;
    if (!named.empty()) {
        const auto unnamed = [&](const Variant& variant) {
            return std::find(named.begin(), named.end(), variant.name) == named.end();
        };
        std::erase_if(methods, unnamed);
        std::erase_if(ablations, unnamed);
        if (methods.size() + ablations.size() != named.size()) {
            fmt::print(stderr, "--only names no variant; there are:\n");
            for (const std::vector<Variant>& list : {kMethods, kAblations})
                for (const Variant& variant : list) fmt::print(stderr, "    {}\n", variant.name);
            return 2;
        }
    }
    if (!std::filesystem::is_directory(folder)) {
        fmt::print(
            stderr,
            "there is no folder {}: this benchmark needs meshes with gt_A_to_B_CROP.csv files of their "
            "true correspondence; name their folder\n",
            folder);
        return 2;
    }
    std::vector<AccuracyPair> pairs = real_pairs(folder);
    for (const AccuracyPair& pair : pairs) {
        const Outcome outcome = run(pair, {});
        fmt::print("{:45} {:.3f} / {:.3f} %, {:.1f} s\n", pair.name, outcome.score.mean, outcome.score.p95,
                   outcome.seconds);
        std::fflush(stdout);
    }
    fmt::print("\n");
    for (std::vector<AccuracyPair> more :
         {reversed_pairs(pairs), synthetic_pairs(folder), noisy_pairs(folder)})
        pairs.insert(pairs.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
    print_table(methods, pairs);
    if (ablation || !named.empty()) {
        fmt::print("\n");
        print_table(ablations, pairs);
    }
    return 0;
}

}  // namespace automorph::bench
