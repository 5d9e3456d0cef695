#include "tests/bench/registration_bench.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <utility>
#include <vector>

#include "morph/alignment/coarse.h"
#include "morph/alignment/places.h"
#include "morph/mesh/connectivity.h"
#include "morph/morph.h"
#include "morph/registration/registration.h"
#include "tests/bench/number.h"
#include "tests/bench/open3d.h"
#include "tests/morph/registration/shapes.h"

namespace automorph::bench {

namespace {

constexpr double kSuccess = 5.0;  // degrees
/// A pose in which the clean shapes lie this near each other (root mean square both ways, % of the diagonal)
/// is as right as the true one: the shape has a symmetry.
constexpr double kSameShape = 0.5;

// Free forms, limbs, open and closed; the last three have symmetries.
const std::vector<std::string> kMeshes = {"head",  "hand",        "lion-head", "mannequin-devil", "nefertiti",
                                          "homer", "retinal",     "bunny00",   "camel",           "cow",
                                          "dino",  "man",         "pig",       "armadillo",       "bear",
                                          "bull",  "triceratops", "mushroom",  "ellipsoid",       "sphere"};

enum class Kind { Clean, Noise1, Noise3, Part };
constexpr std::array kKinds{Kind::Clean, Kind::Noise1, Kind::Noise3, Kind::Part};
constexpr std::array<const char*, 4> kKindNames{"clean", "1 % noise", "3 % noise", "20 % missing"};

struct Tally {
    int tries = 0, right = 0, as_good = 0, wrong_but_sure = 0, right_but_unsure = 0;
    std::string cell() const {
        return fmt::format("{}{} of {}", right, as_good > 0 ? fmt::format(" + {}", as_good) : "", tries);
    }
    void add(const Tally& other) {
        tries += other.tries;
        right += other.right;
        as_good += other.as_good;
        wrong_but_sure += other.wrong_but_sure;
        right_but_unsure += other.right_but_unsure;
    }
};

/// Without the fifth of its area that lies farthest in a random direction.
Mesh part_of(const Mesh& mesh, test::Random& random) {
    const Eigen::Vector3d direction = random.normal3().normalized();
    const Eigen::VectorXd areas = triangle_areas(mesh);
    std::vector<std::pair<double, int>> order;
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        const Eigen::RowVector3d centre =
            mesh.V.row(mesh.F(f, 0)) + mesh.V.row(mesh.F(f, 1)) + mesh.V.row(mesh.F(f, 2));
        order.emplace_back(centre.dot(direction), f);
    }
    std::sort(order.begin(), order.end());
    double kept_area = 0.0;
    std::vector<int> kept;
    for (const auto& [height, f] : order) {
        if (kept_area > 0.8 * areas.sum()) break;
        kept_area += areas[f];
        kept.push_back(f);
    }
    return {mesh.V, mesh.F(kept, Eigen::all)};
}

double one_sided(const Points& from, const Mesh& to) {
    const std::vector<SurfacePlace> places = places_on(to, from, Points::Zero(from.rows(), 3));
    double sum = 0.0;
    for (Eigen::Index v = 0; v < from.rows(); ++v)
        sum += (places[static_cast<std::size_t>(v)].in(to.V) - from.row(v)).squaredNorm();
    return sum / static_cast<double>(from.rows());
}

/// Root mean square distance of the clean shape in the pose found from itself in the true one, % of the
/// diagonal.
double shape_distance(const Mesh& found, const Mesh& truth) {
    return 100.0 * std::sqrt(0.5 * (one_sided(found.V, truth) + one_sided(truth.V, found))) /
           bounding_box_diagonal(truth.V);
}

double cpu_seconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// A shape and a posed copy of it, which are to be registered.
struct Trial {
    Mesh source, target;
    Mesh truth;  ///< the clean shape in the true pose
    Eigen::Matrix3d R;
    double scale;
};

Trial trial(const Mesh& mesh, const Mesh& other, Kind kind, std::uint64_t seed) {
    test::Random random(seed);
    const Eigen::Matrix3d R = random.rotation();
    const Eigen::Vector3d t = 5.0 * random.normal3();
    const double scale = std::exp(random.normal());
    Mesh a = mesh, b = other;
    if (kind == Kind::Noise1 || kind == Kind::Noise3) {
        const double noise = kind == Kind::Noise1 ? 0.01 : 0.03;
        a = test::with_noise(a, noise, random);
        b = test::with_noise(b, noise, random);
    }
    if (kind == Kind::Part) b = part_of(b, random);
    return {std::move(a), test::moved(b, R, t, scale), test::moved(mesh, R, t, scale), R, scale};
}

void judge(const Trial& trial, const Mesh& mesh, const Eigen::Matrix3d& found, bool confident, Tally& tally) {
    const double degrees = Eigen::AngleAxisd(found * trial.R.transpose()).angle() * 180.0 / std::numbers::pi;
    ++tally.tries;
    // What the size of a part says of the whole is judged apart: the turn only.
    const bool right = degrees < kSuccess;
    Mesh placed = test::moved(mesh, found, Eigen::Vector3d::Zero(), trial.scale);
    placed.V.rowwise() += trial.truth.V.colwise().mean() - placed.V.colwise().mean();
    const bool as_good = !right && shape_distance(placed, trial.truth) < kSameShape;
    tally.right += right;
    tally.as_good += as_good;
    tally.wrong_but_sure += !right && !as_good && confident;
    tally.right_but_unsure += right && !confident;
}

/// Ours, and Open3D's of the same trials.
struct Row {
    std::array<Tally, kKinds.size()> ours, theirs;
    double seconds = 0, their_seconds = 0;  ///< CPU, each
};

Row registered(const Mesh& mesh, int poses, std::uint64_t seed, bool open3d) {
    const Mesh other = test::re_tessellated(mesh);
    Row row;
    for (std::size_t k = 0; k < kKinds.size(); ++k) {
        std::vector<Trial> trials;
        std::vector<std::pair<Mesh, Mesh>> pairs;
        for (int pose = 0; pose < poses; ++pose) {
            const std::uint64_t pose_seed = seed + static_cast<std::uint64_t>(pose);
            trials.push_back(trial(mesh, other, kKinds[k], pose_seed));
            const double before = cpu_seconds();
            const Registration found =
                register_rigid(trials.back().source, trials.back().target, {.seed = pose_seed});
            row.seconds += (cpu_seconds() - before) / (static_cast<double>(kKinds.size()) * poses);
            judge(trials.back(), mesh, found.R, found.confident, row.ours[k]);
            pairs.emplace_back(trials.back().source, trials.back().target);
        }
        if (!open3d) continue;
        const std::vector<Open3dPose> their = open3d_rotations(pairs);
        for (std::size_t pose = 0; pose < their.size(); ++pose) {
            row.their_seconds += their[pose].cpu_seconds / (static_cast<double>(kKinds.size()) * poses);
            judge(trials[pose], mesh, their[pose].R, true, row.theirs[k]);
        }
    }
    return row;
}

void print_cells(const std::array<Tally, kKinds.size()>& tallies, double seconds, bool judges_itself) {
    for (const Tally& tally : tallies) {
        const bool bad = judges_itself && tally.wrong_but_sure > 0;
        fmt::print(" {}{} |", tally.cell(),
                   bad ? fmt::format(", {} wrong and sure", tally.wrong_but_sure) : "");
    }
    fmt::print(" {:.2f} |", seconds);
}

void print_time_at_10k() {
    fmt::print("\n| 10,000 vertices | seconds | CPU seconds |\n|---|---|---|\n");
    for (const std::string name : {"bunny00", "armadillo", "mannequin-devil", "bear"}) {
        const Mesh mesh = load_mesh(std::string(AUTOMORPH_DEMO_MESHES) + "/" + name + ".off").mesh;
        if (mesh.vertex_count() < 10000) continue;
        const auto loops = boundary_loops(mesh, connectivity(mesh.F, mesh.vertex_count()));
        const Mesh a = coarse_mesh(mesh, loops, 10000).mesh, b = test::re_tessellated(a);
        const Mesh c = coarse_mesh(b, boundary_loops(b, connectivity(b.F, b.vertex_count())), 10000).mesh;
        test::Random random(5);
        const Mesh posed = test::moved(c, random.rotation(), {1, 2, 3}, 2.0);
        const double before = cpu_seconds();
        const auto start = std::chrono::steady_clock::now();
        register_rigid(a, posed);
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        fmt::print("| {}, {} + {} | {:.2f} | {:.2f} |\n", name, a.vertex_count(), c.vertex_count(), seconds,
                   cpu_seconds() - before);
    }
}

}  // namespace

int registration_bench(const std::vector<std::string>& words) {
    int poses = 5;
    std::uint64_t seed = 1;
    std::string only;
    bool open3d = false;
    for (std::size_t k = 0; k < words.size(); ++k) {
        const bool last = k + 1 == words.size();
        if (words[k] == "--poses" && !last) {
            poses = number_of("--poses", words[++k], 1);
        } else if (words[k] == "--seed" && !last) {
            seed = number_of<std::uint64_t>("--seed", words[++k], 0);
        } else if (words[k] == "--only" && !last) {
            only = words[++k];
        } else if (words[k] == "--open3d") {
            open3d = true;
        } else {
            fmt::print(stderr, "registration: '{}' is no option, or lacks its value\n", words[k]);
            return 2;
        }
    }
    if (open3d && !has_open3d()) {
        fmt::print("Open3D is not installed (Debian package python3-open3d): ours alone\n\n");
        open3d = false;
    }
    fmt::print("within {} degrees + other poses that fit as well, of {} poses\n\n| mesh | vertices |",
               kSuccess, poses);
    for (const char* whose : {"", "Open3D, "}) {
        if (*whose && !open3d) continue;
        for (const char* kind : kKindNames) fmt::print(" {}{} |", whose, kind);
        fmt::print(" {}CPU s each |", whose);
    }
    fmt::print("\n|---|---|---|---|---|---|---|{}\n", open3d ? "---|---|---|---|---|" : "");
    Row totals;
    for (const std::string& name : kMeshes) {
        if (name.find(only) == std::string::npos) continue;
        const std::string file = std::string(AUTOMORPH_DEMO_MESHES) + "/" + name + ".off";
        if (!std::filesystem::exists(file)) {
            fmt::print(stderr, "registration: there is no {}\n", file);
            return 2;
        }
        const Mesh mesh = load_mesh(file).mesh;
        const Row row = registered(mesh, poses, seed, open3d);
        fmt::print("| {} | {} |", name, mesh.vertex_count());
        print_cells(row.ours, row.seconds, true);
        if (open3d) print_cells(row.theirs, row.their_seconds, false);
        fmt::print("\n");
        std::fflush(stdout);
        for (std::size_t k = 0; k < kKinds.size(); ++k) {
            totals.ours[k].add(row.ours[k]);
            totals.theirs[k].add(row.theirs[k]);
        }
    }
    fmt::print("\n");
    for (std::size_t k = 0; k < kKinds.size(); ++k) {
        const Tally &tally = totals.ours[k], &theirs = totals.theirs[k];
        fmt::print(
            "{}: {:.1f} % right; of {} wrong ones {} reported as sure; of {} right ones {} as unsure{}\n",
            kKindNames[k], 100.0 * (tally.right + tally.as_good) / tally.tries,
            tally.tries - tally.right - tally.as_good, tally.wrong_but_sure, tally.right,
            tally.right_but_unsure,
            open3d ? fmt::format("; Open3D {:.1f} % right",
                                 100.0 * (theirs.right + theirs.as_good) / theirs.tries)
                   : "");
    }
    print_time_at_10k();
    return 0;
}

}  // namespace automorph::bench
