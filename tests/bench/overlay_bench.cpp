#include "tests/bench/overlay_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <filesystem>

#include "cgal_overlay.h"
#include "morph/mesh/admit.h"
#include "morph/mesh/connectivity.h"
#include "morph/mesh/errors.h"
#include "morph/mesh/io.h"
#include "morph/overlay/overlay.h"
#include "morph/parameterization/border.h"
#include "morph/parameterization/disk_map.h"

namespace automorph::bench {

namespace {

using Pair = std::array<std::string, 2>;

/// Sizes from 8 to 43 thousand triangles; all are disks.
const std::vector<Pair> kExamplePairs = {{"three_peaks.off", "mushroom.off"},
                                         {"cylinder_locally_refined.off", "lion-head.off"},
                                         {"lion-head.off", "mannequin-devil.off"},
                                         {"mannequin-devil.off", "mannequin-devil.off"}};

struct InputDisk {
    Mesh mesh;
    std::vector<int> loop;
};

InputDisk read_disk(const std::string& file) {
    InputDisk result;
    result.mesh = admit(read_mesh(file), file).mesh;
    const auto loops = boundary_loops(result.mesh, connectivity(result.mesh.F, result.mesh.vertex_count()));
    if (loops.size() != 1)
        throw InvalidMesh(
            fmt::format("{} has {} boundary loops; the benchmark takes disks", file, loops.size()));
    result.loop = loops.front();
    return result;
}

/// Median CPU seconds of `repeats` calls.
template <typename Work>
double median_seconds(int repeats, const Work& work) {
    std::vector<double> seconds;
    for (int k = 0; k < repeats; ++k) {
        const std::clock_t start = std::clock();
        work();
        seconds.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    std::nth_element(seconds.begin(), seconds.begin() + repeats / 2, seconds.end());
    return seconds[static_cast<std::size_t>(repeats / 2)];
}

/// Prints one row; false if the overlays differ.
bool compare(const Pair& files) {
    const InputDisk a = read_disk(files[0]), b = read_disk(files[1]);
    // Against itself a mesh starts at another border vertex: the maps differ, as those of two scans do.
    BorderControl control;
    if (files[0] == files[1]) control.target = static_cast<int>(b.loop.size()) / 3;
    const CommonBorder border = common_border(a.mesh, a.loop, b.mesh, b.loop, control);
    const Points circle = border_rays(border.angles);
    const Mesh &mesh_a = border.source.mesh, &mesh_b = border.target.mesh;
    const Points rays_a = disk_map(mesh_a, border.source.loop, circle).rays;
    const Points rays_b = disk_map(mesh_b, border.target.loop, circle).rays;

    Overlay ours;
    const double our_seconds = median_seconds(31, [&] { ours = overlay(mesh_a, rays_a, mesh_b, rays_b); });
    const CgalOverlay cgal(mesh_a, rays_a, mesh_b, rays_b);
    CgalOverlay::Counts theirs{};
    const double their_seconds = median_seconds(3, [&] { theirs = cgal.run(); });

    const auto stem = [](const std::string& file) { return std::filesystem::path(file).stem().string(); };
    fmt::print("{:<42} {:>6} {:>6} {:>8} {:>8.4f} {:>8.4f} {:>6.1f} {:>8.0f}\n",
               stem(files[0]) + " + " + stem(files[1]), mesh_a.triangle_count(), mesh_b.triangle_count(),
               ours.vertex_count(), our_seconds, their_seconds, their_seconds / our_seconds,
               1e9 * our_seconds / ours.vertex_count());
    std::fflush(stdout);
    if (theirs.vertices == ours.vertex_count() && theirs.faces == ours.face_count()) return true;
    fmt::print("  differ: {} vertices and {} faces here, {} and {} in CGAL's overlay\n", ours.vertex_count(),
               ours.face_count(), theirs.vertices, theirs.faces);
    return false;
}

}  // namespace

int overlay_bench(const std::vector<std::string>& files) {
    std::vector<Pair> pairs;
    if (files.size() % 2 != 0) {
        fmt::print(stderr, "automorph_bench overlay: {} files; expected pairs\n", files.size());
        return 2;
    }
    for (std::size_t k = 0; k < files.size(); k += 2) pairs.push_back({files[k], files[k + 1]});
    if (pairs.empty()) {
        const std::string folder = AUTOMORPH_DEMO_MESHES "/";
        for (const Pair& pair : kExamplePairs) pairs.push_back({folder + pair[0], folder + pair[1]});
    }
    fmt::print(
        "Overlay of two disk maps; CPU seconds, medians. ours: connectivity and overlay; CGAL: overlay of\n"
        "two finished arrangements of segments with exact constructions.\n\n"
        "{:<42} {:>6} {:>6} {:>8} {:>8} {:>8} {:>6} {:>8}\n",
        "maps", "#F a", "#F b", "merged", "ours", "CGAL", "ratio", "ns/vert");
    bool same = true;
    for (const Pair& pair : pairs) same = compare(pair) && same;
    return same ? 0 : 1;
}

}  // namespace automorph::bench
