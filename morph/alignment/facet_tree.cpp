#include "morph/alignment/facet_tree.h"

#include <algorithm>
#include <numeric>

namespace automorph {

namespace {

constexpr int kLeaf = 4;  // triangles

}  // namespace

FacetTree::FacetTree(const Mesh& mesh, const Points& normals)
    : triangles_(static_cast<std::size_t>(mesh.triangle_count())) {
    std::iota(triangles_.begin(), triangles_.end(), 0);
    Points centroids(mesh.triangle_count(), 3);
    for (int f = 0; f < mesh.triangle_count(); ++f)
        centroids.row(f) = mesh.V(mesh.F.row(f), Eigen::all).colwise().mean();
    nodes_.reserve(triangles_.size());
    if (!triangles_.empty()) build(0, mesh.triangle_count(), mesh, normals, centroids);
}

void FacetTree::build(int begin, int end, const Mesh& mesh, const Points& normals, const Points& centroids) {
    const std::size_t index = nodes_.size();
    nodes_.emplace_back();
    nodes_[index].begin = begin;
    nodes_[index].end = end;
    Bounds bounds;
    if (end - begin <= kLeaf) {
        for (int i = begin; i < end; ++i) {
            const int f = triangles_[static_cast<std::size_t>(i)];
            for (int k = 0; k < 3; ++k) bounds.places.extend(mesh.V.row(mesh.F(f, k)).transpose());
            bounds.normals.extend(normals.row(f).transpose());
        }
    } else {
        Eigen::AlignedBox3d box;
        for (int i = begin; i < end; ++i)
            box.extend(centroids.row(triangles_[static_cast<std::size_t>(i)]).transpose());
        Eigen::Index axis = 0;
        box.sizes().maxCoeff(&axis);
        const int middle = begin + (end - begin) / 2;
        std::nth_element(triangles_.begin() + begin, triangles_.begin() + middle, triangles_.begin() + end,
                         [&](int f, int g) {
                             const double x = centroids(f, axis), y = centroids(g, axis);
                             return x < y || (x == y && f < g);
                         });
        build(begin, middle, mesh, normals, centroids);
        const std::size_t right = nodes_.size();
        build(middle, end, mesh, normals, centroids);
        nodes_[index].right = static_cast<int>(right);
        bounds = nodes_[index + 1].bounds;
        bounds.places.extend(nodes_[right].bounds.places);
        bounds.normals.extend(nodes_[right].bounds.normals);
    }
    nodes_[index].bounds = bounds;
}

}  // namespace automorph
