#include "morph/halves.h"

namespace automorph {

Disk disk_of(const CutMesh& cut_mesh, std::size_t which) {
    const Half& half = cut_mesh.halves[which];
    Disk disk{half.mesh, half.loop, {}};
    for (const int v : half.vertex) {
        if (v >= 0) {
            disk.sites.push_back(site_of_vertex(v));
        } else {
            const auto& point = cut_mesh.points[static_cast<std::size_t>(-1 - v)];
            disk.sites.push_back({{point.from, point.to, -1}, {1.0 - point.ratio, point.ratio, 0.0}, 2});
        }
    }
    return disk;
}

MergedPair glued(const MergedPair& first, const MergedPair& second) {
    MergedPair all = first;
    // Vertex k of the first's border is vertex (n - k) mod n of the second's.
    std::vector<int> vertex(second.on_a.size(), -1);
    const std::size_t n = first.border.size();
    for (std::size_t k = 0; k < n; ++k) {
        vertex[static_cast<std::size_t>(second.border[(n - k) % n])] = first.border[k];
    }
    std::vector<int> own;  // vertices of the second that are not on the border
    for (std::size_t v = 0; v < vertex.size(); ++v) {
        if (vertex[v] >= 0) continue;
        vertex[v] = static_cast<int>(all.on_a.size());
        all.on_a.push_back(second.on_a[v]);
        all.on_b.push_back(second.on_b[v]);
        own.push_back(static_cast<int>(v));
    }
    all.points_a.conservativeResize(static_cast<Eigen::Index>(all.on_a.size()), 3);
    all.points_b.conservativeResize(static_cast<Eigen::Index>(all.on_b.size()), 3);
    const auto added = static_cast<Eigen::Index>(own.size());
    all.points_a.bottomRows(added) = second.points_a(own, Eigen::all);
    all.points_b.bottomRows(added) = second.points_b(own, Eigen::all);
    all.F.conservativeResize(first.F.rows() + second.F.rows(), 3);
    for (Eigen::Index f = 0; f < second.F.rows(); ++f) {
        for (int k = 0; k < 3; ++k)
            all.F(first.F.rows() + f, k) = vertex[static_cast<std::size_t>(second.F(f, k))];
    }
    all.in_filling.insert(all.in_filling.end(), second.in_filling.begin(), second.in_filling.end());
    all.maps.insert(all.maps.end(), second.maps.begin(), second.maps.end());
    all.border.clear();
    return all;
}

}  // namespace automorph
