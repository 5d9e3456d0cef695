#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

/// Bounding-volume hierarchy over the triangles of a mesh, whose nodes bound the places of their triangles
/// and their normals, too: a search leaves out what lies too far away and what faces the wrong way. Searches
/// may run from several threads.
class FacetTree {
public:
    /// What the triangles of a node share.
    struct Bounds {
        Eigen::AlignedBox3d places, normals;
    };

    /// @param normals  #F x 3 unit normals, or zero
    FacetTree(const Mesh& mesh, const Points& normals);

    /// Calls visit(f) for triangles, near ones early, but for those of nodes with lowest(bounds) > limit.
    /// @param lowest  a lower bound of what is searched for over all that lies within the bounds
    /// @param limit   read anew at each node: `visit` may lower it
    template <typename Lowest, typename Visit>
    void search(const Lowest& lowest, const double& limit, const Visit& visit) const {
        if (!nodes_.empty()) search(0, lowest(nodes_[0].bounds), lowest, limit, visit);
    }

private:
    struct Node {
        Bounds bounds;
        int begin = 0, end = 0;  ///< into triangles_
        int right = 0;           ///< second child, the first follows its parent; 0: a leaf
    };

    void build(int begin, int end, const Mesh& mesh, const Points& normals, const Points& centroids);

    template <typename Lowest, typename Visit>
    void search(int index, double bound, const Lowest& lowest, const double& limit,
                const Visit& visit) const {
        if (bound > limit) return;
        const Node& node = nodes_[static_cast<std::size_t>(index)];
        if (node.right == 0) {
            for (int i = node.begin; i < node.end; ++i) visit(triangles_[static_cast<std::size_t>(i)]);
            return;
        }
        const int left = index + 1, right = node.right;
        const double of_left = lowest(nodes_[static_cast<std::size_t>(left)].bounds),
                     of_right = lowest(nodes_[static_cast<std::size_t>(right)].bounds);
        const bool left_first = of_left <= of_right;
        if (left_first) search(left, of_left, lowest, limit, visit);
        search(right, of_right, lowest, limit, visit);
        if (!left_first) search(left, of_left, lowest, limit, visit);
    }

    std::vector<Node> nodes_;
    std::vector<int> triangles_;
};

}  // namespace automorph
