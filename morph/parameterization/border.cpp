#include "morph/parameterization/border.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "morph/mesh/errors.h"
#include "morph/mesh/index.h"

namespace automorph {

namespace {

/// Finds which triangle edges are border edges.
class BorderEdges {
public:
    BorderEdges(const Mesh& mesh, const std::vector<int>& loop)
        : loop_(loop), place_(at(mesh.vertex_count()), -1) {
        for (std::size_t k = 0; k < loop.size(); ++k) place_[at(loop[k])] = static_cast<int>(k);
    }

    /// Index of the loop edge u -> v (from loop[e] to loop[e + 1]), or -1.
    int find(int u, int v) const {
        const int e = place_[at(u)];
        return e >= 0 && loop_[(at(e) + 1) % loop_.size()] == v ? e : -1;
    }

private:
    const std::vector<int>& loop_;
    std::vector<int> place_;
};

using Triangle = std::array<int, 3>;

double length(const Points& V, int i, int j) {
    return (V.row(i) - V.row(j)).norm();
}

/// Triangulates between two chains that leave one corner, left[0] = right[0]: the shorter of the two next
/// edges is taken. Seen from outside `left` runs clockwise. The last triangle holds the edge left.back(),
/// right.back().
std::vector<Triangle> strip(const Points& V, const std::vector<int>& left, const std::vector<int>& right) {
    std::vector<Triangle> parts{{left[1], left[0], right[1]}};
    std::size_t i = 1, j = 1;
    while (i + 1 < left.size() || j + 1 < right.size()) {
        const bool advance_left =
            j + 1 == right.size() ||
            (i + 1 < left.size() && length(V, left[i + 1], right[j]) <= length(V, left[i], right[j + 1]));
        if (advance_left) {
            parts.push_back({left[i + 1], left[i], right[j]});
            ++i;
        } else {
            parts.push_back({left[i], right[j], right[j + 1]});
            ++j;
        }
    }
    return parts;
}

/// Parts of triangle a b c with points inserted on its edges ab, bc and ca (the last only if bc is on the
/// border too: a mesh of one triangle).
std::vector<Triangle> split(const Points& V, const Triangle& corners, const std::vector<int>& on_ab,
                            const std::vector<int>& on_bc, const std::vector<int>& on_ca) {
    const auto [a, b, c] = corners;
    std::vector<int> left{b}, right{b};
    left.insert(left.end(), on_ab.rbegin(), on_ab.rend());
    left.push_back(a);
    right.insert(right.end(), on_bc.begin(), on_bc.end());
    right.push_back(c);
    std::vector<Triangle> parts = strip(V, left, right);
    if (on_ca.empty()) return parts;
    // The last part holds the edge ca: fan from its third corner.
    const Triangle last = parts.back();
    parts.pop_back();
    const int apex = last[0] + last[1] + last[2] - a - c;
    int from = c;
    for (const int r : on_ca) {
        parts.push_back({from, r, apex});
        from = r;
    }
    parts.push_back({from, a, apex});
    return parts;
}

}  // namespace

BorderedMesh insert_border(const Mesh& mesh, const std::vector<int>& loop,
                           const std::vector<BorderSite>& sites) {
    const int loop_size = static_cast<int>(loop.size());
    BorderedMesh result;
    result.mesh.F = mesh.F;

    // Vertices: the union in order.
    for (const BorderSite& site : sites) {
        const int from = loop[at(site.from)], to = loop[at(site.to)];
        if (site.is_vertex()) {
            result.loop.push_back(from);
            continue;
        }
        result.loop.push_back(mesh.vertex_count() + static_cast<int>(result.inserted.size()));
        result.inserted.push_back({from, to, site.ratio});
    }
    // New ones listed per loop edge, along it: from a vertex of the loop on, as the union may begin amid an
    // edge.
    std::vector<std::vector<int>> on_edge(loop.size());
    const auto first =
        std::find_if(sites.begin(), sites.end(), [](const BorderSite& s) { return s.is_vertex(); });
    for (std::size_t k = 0; k < sites.size(); ++k) {
        const std::size_t s = (static_cast<std::size_t>(first - sites.begin()) + k) % sites.size();
        if (sites[s].is_vertex()) continue;
        const bool forwards = (sites[s].from + 1) % loop_size == sites[s].to;
        on_edge[at(forwards ? sites[s].from : sites[s].to)].push_back(result.loop[s]);
    }
    result.mesh.V.resize(mesh.vertex_count() + static_cast<Eigen::Index>(result.inserted.size()), 3);
    result.mesh.V.topRows(mesh.vertex_count()) = mesh.V;
    for (std::size_t k = 0; k < result.inserted.size(); ++k) {
        const auto [from, to, ratio] = result.inserted[k];
        result.mesh.V.row(mesh.vertex_count() + static_cast<Eigen::Index>(k)) =
            (1.0 - ratio) * mesh.V.row(from) + ratio * mesh.V.row(to);
    }

    // Triangles: border triangles are split.
    const BorderEdges border(mesh, loop);
    const std::vector<int> none;
    std::vector<Triangle> added;
    int found = 0;
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        std::array<int, 3> edge{};
        int on_border = 0;
        for (int k = 0; k < 3; ++k) {
            edge[at(k)] = border.find(mesh.F(f, k), mesh.F(f, (k + 1) % 3));
            if (edge[at(k)] >= 0) ++on_border;
        }
        if (on_border == 0) continue;
        found += on_border;
        // Corner a such that ab is a border edge, and bc too if there are two.
        int a = 0;
        while (edge[at(a)] < 0 || (on_border == 2 && edge[at((a + 1) % 3)] < 0)) ++a;
        const auto points = [&](int k) -> const std::vector<int>& {
            return edge[at(k % 3)] >= 0 ? on_edge[at(edge[at(k % 3)])] : none;
        };
        const Triangle corners{mesh.F(f, a), mesh.F(f, (a + 1) % 3), mesh.F(f, (a + 2) % 3)};
        if (points(a).empty() && points(a + 1).empty() && points(a + 2).empty()) continue;
        const auto parts = split(result.mesh.V, corners, points(a), points(a + 1), points(a + 2));
        for (int k = 0; k < 3; ++k) result.mesh.F(f, k) = parts[0][at(k)];
        added.insert(added.end(), parts.begin() + 1, parts.end());
        result.parent.insert(result.parent.end(), parts.size() - 1, f);
    }
    if (found != loop_size) {
        throw InvalidMesh(fmt::format(
            "the border of {} edges is not a boundary loop of the mesh: {} of its edges belong to a triangle",
            loop_size, found));
    }
    result.mesh.F.conservativeResize(mesh.triangle_count() + static_cast<Eigen::Index>(added.size()), 3);
    for (std::size_t k = 0; k < added.size(); ++k) {
        for (int c = 0; c < 3; ++c)
            result.mesh.F(mesh.triangle_count() + static_cast<int>(k), c) = added[k][at(c)];
    }
    return result;
}

CommonBorder common_border(const Mesh& source, const std::vector<int>& source_loop, const Mesh& target,
                           const std::vector<int>& target_loop, const BorderControl& control) {
    const BorderUnion u =
        border_union(loop_points(source, source_loop), loop_points(target, target_loop), control);
    return {insert_border(source, source_loop, u.source), insert_border(target, target_loop, u.target),
            u.angles, u.shared};
}

}  // namespace automorph
