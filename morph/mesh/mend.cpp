#include "morph/mesh/mend.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <numeric>

#include "morph/mesh/errors.h"
#include "morph/mesh/geometry.h"

namespace automorph {

namespace {

// A stray component or patch has less than this share of the area, and less than the same share of the
// triangles or only a few; all strays together have less than kStraysTogether of the area.
constexpr double kStrayShare = 0.01;
constexpr int kStrayTriangles = 10;
constexpr double kStraysTogether = 0.05;
// Patches on edges of three or more triangles are dropped one by one; a mesh with more of them is no stray
// case.
constexpr int kMostPatches = 100;

std::string plural(int count, const char* one, const char* several) {
    return fmt::format("{} {}", count, count == 1 ? one : several);
}

/// Keeps the triangles with keep[t] != 0; returns how many went.
int keep_triangles(Draft& draft, const std::vector<char>& keep) {
    int kept = 0;
    for (int t = 0; t < draft.F.rows(); ++t) {
        if (!keep[t]) continue;
        draft.F.row(kept) = draft.F.row(t);
        draft.polygon[kept] = draft.polygon[t];
        ++kept;
    }
    const int dropped = static_cast<int>(draft.F.rows()) - kept;
    draft.F.conservativeResize(kept, 3);
    draft.polygon.resize(static_cast<std::size_t>(kept));
    return dropped;
}

struct Sizes {
    std::vector<double> area;
    std::vector<int> triangles;
    double total_area = 0.0;
};

Sizes component_sizes(const Draft& draft, const Labels& components) {
    const Eigen::VectorXd areas = triangle_areas({draft.V, draft.F});
    Sizes sizes{std::vector<double>(components.count, 0.0), std::vector<int>(components.count, 0),
                areas.sum()};
    for (int t = 0; t < draft.F.rows(); ++t) {
        sizes.area[components.of[t]] += areas[t];
        ++sizes.triangles[components.of[t]];
    }
    return sizes;
}

bool is_small(const Sizes& sizes, int component, Eigen::Index all_triangles) {
    return sizes.area[component] < kStrayShare * sizes.total_area &&
           (sizes.triangles[component] <= kStrayTriangles ||
            sizes.triangles[component] < kStrayShare * static_cast<double>(all_triangles));
}

/// Per component: does it touch an edge of three or more triangles?
std::vector<char> attached_components(const EdgeTable& edges, const Labels& components) {
    std::vector<char> attached(static_cast<std::size_t>(components.count), 0);
    for (int e = 0; e < edges.edge_count(); ++e) {
        for (int k = 0; edges.use_count(e) > 2 && k < edges.use_count(e); ++k) {
            attached[components.of[edges.use(e, k).triangle]] = 1;
        }
    }
    return attached;
}

void drop_loose_components(Draft& draft) {
    const EdgeTable edges = edge_table(draft.F);
    const Labels components = edge_components(draft.F, edges);
    if (components.count < 2) return;
    const Sizes sizes = component_sizes(draft, components);
    const std::vector<char> attached = attached_components(edges, components);
    std::vector<char> small(static_cast<std::size_t>(components.count), 0);
    double stray_area = 0.0;
    int strays = 0;
    for (int c = 0; c < components.count; ++c) {
        if (attached[c] || !is_small(sizes, c, draft.F.rows())) continue;
        small[c] = 1;
        ++strays;
        stray_area += sizes.area[c];
    }
    if (strays == 0 || !(stray_area <= kStraysTogether * sizes.total_area)) return;
    std::vector<char> keep(components.of.size());
    for (std::size_t t = 0; t < keep.size(); ++t) keep[t] = !small[components.of[t]];
    const int dropped = keep_triangles(draft, keep);
    draft.mended.push_back(fmt::format(
        "dropped {} in {} ({:.2g} % of the area)", plural(dropped, "stray triangle", "stray triangles"),
        plural(strays, "loose piece", "loose pieces"), 100.0 * stray_area / sizes.total_area));
}

void drop_attached_patches(Draft& draft) {
    int dropped = 0, patches = 0;
    for (; patches < kMostPatches; ++patches) {
        const EdgeTable edges = edge_table(draft.F);
        const Labels components = edge_components(draft.F, edges);
        const std::vector<char> attached = attached_components(edges, components);
        const Sizes sizes = component_sizes(draft, components);
        int smallest = -1;
        for (int c = 0; c < components.count; ++c) {
            if (!attached[c] || !is_small(sizes, c, draft.F.rows())) continue;
            if (smallest < 0 || sizes.area[c] < sizes.area[smallest]) smallest = c;
        }
        if (smallest < 0) break;
        std::vector<char> keep(components.of.size());
        for (std::size_t t = 0; t < keep.size(); ++t) keep[t] = components.of[t] != smallest;
        dropped += keep_triangles(draft, keep);
    }
    if (dropped == 0) return;
    draft.mended.push_back(fmt::format("dropped {} in {} on edges that three or more triangles shared",
                                       plural(dropped, "triangle", "triangles"),
                                       plural(patches, "small patch", "small patches")));
}

std::uint64_t hash_of(const std::array<std::uint64_t, 3>& key) {
    std::uint64_t h = 0;
    for (const std::uint64_t part : key) {
        h = (h ^ part) * 0x9e3779b97f4a7c15ULL;
        h ^= h >> 29;
    }
    return h;
}

}  // namespace

Labels coincident_vertices(const Points& V) {
    const auto key = [&](int v) {
        std::array<std::uint64_t, 3> bits{};
        for (int k = 0; k < 3; ++k) bits[k] = std::bit_cast<std::uint64_t>(V(v, k) + 0.0);  // -0 becomes 0
        return bits;
    };
    Labels labels;
    labels.of.resize(static_cast<std::size_t>(V.rows()));
    const std::size_t mask = std::bit_ceil(2 * static_cast<std::size_t>(V.rows()) + 1) - 1;
    std::vector<int> slots(mask + 1, -1);  // first vertex at a place; open addressing
    for (int v = 0; v < V.rows(); ++v) {
        const auto wanted = key(v);
        std::size_t slot = hash_of(wanted) & mask;
        while (slots[slot] >= 0 && key(slots[slot]) != wanted) slot = (slot + 1) & mask;
        if (slots[slot] < 0) {
            slots[slot] = v;
            labels.of[v] = labels.count++;
        } else {
            labels.of[v] = labels.of[slots[slot]];
        }
    }
    return labels;
}

void merge_coincident_vertices(Draft& draft) {
    const Labels places = coincident_vertices(draft.V);
    const int merged = static_cast<int>(draft.V.rows()) - places.count;
    if (merged == 0) return;
    int next = 0;
    for (int v = 0; v < draft.V.rows(); ++v) {
        if (places.of[v] != next) continue;  // not the first at its place
        draft.V.row(next) = draft.V.row(v);
        draft.file_vertex[next] = draft.file_vertex[v];
        ++next;
    }
    draft.V.conservativeResize(next, 3);
    draft.file_vertex.resize(static_cast<std::size_t>(next));
    for (Eigen::Index c = 0; c < draft.F.size(); ++c) draft.F.data()[c] = places.of[draft.F.data()[c]];
    for (int& v : draft.vertex_of_file) v = v < 0 ? v : places.of[v];
    draft.mended.push_back(
        fmt::format("merged {}", plural(merged, "duplicate vertex", "duplicate vertices")));
}

void drop_degenerate_and_duplicate_triangles(Draft& draft) {
    const int faces = static_cast<int>(draft.F.rows());
    std::vector<char> keep(static_cast<std::size_t>(faces));
    for (int t = 0; t < faces; ++t) {
        const auto f = draft.F.row(t);
        keep[t] = f[0] != f[1] && f[1] != f[2] && f[2] != f[0];
    }
    const int degenerate = keep_triangles(draft, keep);
    if (degenerate > 0) {
        draft.mended.push_back(
            fmt::format("dropped {} with a repeated corner", plural(degenerate, "triangle", "triangles")));
    }
    std::vector<std::array<int, 4>> sorted(static_cast<std::size_t>(draft.F.rows()));
    for (int t = 0; t < draft.F.rows(); ++t) {
        sorted[t] = {draft.F(t, 0), draft.F(t, 1), draft.F(t, 2), t};
        std::sort(sorted[t].begin(), sorted[t].begin() + 3);
    }
    std::sort(sorted.begin(), sorted.end());
    keep.assign(sorted.size(), 1);
    for (std::size_t i = 1; i < sorted.size(); ++i) {
        if (std::equal(sorted[i].begin(), sorted[i].begin() + 3, sorted[i - 1].begin()))
            keep[sorted[i][3]] = 0;
    }
    const int duplicate = keep_triangles(draft, keep);
    if (duplicate > 0) {
        draft.mended.push_back(
            fmt::format("dropped {}", plural(duplicate, "duplicate triangle", "duplicate triangles")));
    }
}

void drop_strays(Draft& draft) {
    if (edge_components(draft.F, edge_table(draft.F)).count < 2) return;
    drop_loose_components(draft);
    drop_attached_patches(draft);
}

void orient(Draft& draft, const std::string& name) {
    const EdgeTable edges = edge_table(draft.F);
    const Orientation found = consistent_orientation(draft.F, edges, edge_components(draft.F, edges));
    if (found.conflicting_edge >= 0) {
        const EdgeUse& use = edges.use(found.conflicting_edge, 0);
        throw InvalidMesh(fmt::format(
            "{}: the surface is one-sided, like a Moebius strip: its triangles cannot agree which side is "
            "out (seen "
            "at face {}, edge between vertices {} and {}); cut it open there or make a two-sided shape",
            name, draft.polygon[use.triangle], draft.file_vertex[use.low], draft.file_vertex[use.high]));
    }
    int turned = 0;
    for (int t = 0; t < draft.F.rows(); ++t) {
        if (!found.flip[t]) continue;
        std::swap(draft.F(t, 1), draft.F(t, 2));
        ++turned;
    }
    if (turned > 0) {
        draft.mended.push_back(
            fmt::format("turned {} to agree with the others", plural(turned, "triangle", "triangles")));
    }
}

void split_vertices(Draft& draft) {
    const Labels fans = umbrellas(draft.F, edge_table(draft.F));
    std::vector<int> vertex_of_fan(fans.count, -1), size(fans.count, 0);
    for (const int fan : fans.of) ++size[fan];
    // The largest umbrella (the first of equals) keeps the vertex.
    std::vector<int> owner(static_cast<std::size_t>(draft.V.rows()), -1);
    for (Eigen::Index c = 0; c < draft.F.size(); ++c) {
        int& best = owner[draft.F.data()[c]];
        if (best < 0 || size[fans.of[c]] > size[best]) best = fans.of[c];
    }
    std::vector<int> added;  // per new vertex: the one it is a copy of
    const int before = static_cast<int>(draft.V.rows());
    for (Eigen::Index c = 0; c < draft.F.size(); ++c) {
        int& v = draft.F.data()[c];
        int& mine = vertex_of_fan[fans.of[c]];
        if (mine < 0 && owner[v] == fans.of[c]) mine = v;
        if (mine < 0) {
            mine = before + static_cast<int>(added.size());
            added.push_back(v);
        }
        v = mine;
    }
    if (added.empty()) return;
    draft.V.conservativeResize(before + static_cast<int>(added.size()), 3);
    for (std::size_t i = 0; i < added.size(); ++i) {
        draft.V.row(before + static_cast<int>(i)) = draft.V.row(added[i]);
        draft.file_vertex.push_back(draft.file_vertex[added[i]]);
    }
    std::vector<int> distinct = added;
    std::sort(distinct.begin(), distinct.end());
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    draft.mended.push_back(fmt::format("split {} at which parts of the surface only touched (the first: {})",
                                       plural(static_cast<int>(distinct.size()), "vertex", "vertices"),
                                       draft.file_vertex[added.front()]));
}

void drop_unused_vertices(Draft& draft) {
    std::vector<int> place(static_cast<std::size_t>(draft.V.rows()), -1);
    for (Eigen::Index c = 0; c < draft.F.size(); ++c) place[draft.F.data()[c]] = 0;
    int next = 0;
    for (int v = 0; v < draft.V.rows(); ++v) {
        if (place[v] < 0) continue;
        place[v] = next;
        draft.V.row(next) = draft.V.row(v);
        draft.file_vertex[next] = draft.file_vertex[v];
        ++next;
    }
    const int dropped = static_cast<int>(draft.V.rows()) - next;
    if (dropped == 0) return;
    draft.V.conservativeResize(next, 3);
    draft.file_vertex.resize(static_cast<std::size_t>(next));
    for (Eigen::Index c = 0; c < draft.F.size(); ++c) draft.F.data()[c] = place[draft.F.data()[c]];
    for (int& v : draft.vertex_of_file) v = v < 0 ? v : place[v];
    draft.mended.push_back(fmt::format("dropped {}", plural(dropped, "unused vertex", "unused vertices")));
}

void turn_outwards(Draft& draft) {
    if (!(signed_volume({draft.V, draft.F}) < 0.0)) return;
    for (int t = 0; t < draft.F.rows(); ++t) std::swap(draft.F(t, 1), draft.F(t, 2));
    draft.mended.push_back("turned the surface inside out: it faced inwards");
}

}  // namespace automorph
