#include "morph/mesh/edges.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace automorph {

namespace {

/// Union-find with path halving.
class DisjointSets {
public:
    explicit DisjointSets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0); }
    int find(int x) {
        while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
        return x;
    }
    void join(int x, int y) {
        x = find(x);
        y = find(y);
        parent_[std::max(x, y)] = std::min(x, y);
    }
    Labels labels() {
        Labels result;
        result.of.resize(parent_.size());
        for (std::size_t i = 0; i < parent_.size(); ++i) {
            const int root = find(static_cast<int>(i));
            result.of[i] = root == static_cast<int>(i) ? result.count++ : result.of[root];
        }
        return result;
    }

private:
    std::vector<int> parent_;
};

/// The corner of a use's triangle that lies at `vertex`, as 3 * triangle + corner.
int corner_at(const EdgeUse& use, int vertex) {
    const int first = use.forward ? use.low : use.high;
    return 3 * use.triangle + (vertex == first ? use.corner : (use.corner + 1) % 3);
}

}  // namespace

EdgeTable edge_table(const Triangles& F) {
    EdgeTable table;
    table.uses.resize(static_cast<std::size_t>(F.size()));
    // Counting sort by the lower vertex, then a few entries each.
    std::vector<int> bucket(F.size() > 0 ? static_cast<std::size_t>(F.maxCoeff()) + 2 : 1, 0);
    const auto low_of = [&](int t, int k) { return std::min(F(t, k), F(t, (k + 1) % 3)); };
    for (int t = 0; t < F.rows(); ++t) {
        for (int k = 0; k < 3; ++k) ++bucket[low_of(t, k) + 1];
    }
    std::partial_sum(bucket.begin(), bucket.end(), bucket.begin());
    std::vector<int> next(bucket.begin(), bucket.end() - 1);
    for (int t = 0; t < F.rows(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const int from = F(t, k), to = F(t, (k + 1) % 3);
            table.uses[next[low_of(t, k)]++] = {std::min(from, to), std::max(from, to), t, k, from < to};
        }
    }
    for (std::size_t v = 0; v + 1 < bucket.size(); ++v) {
        std::sort(table.uses.begin() + bucket[v], table.uses.begin() + bucket[v + 1],
                  [](const EdgeUse& x, const EdgeUse& y) {
                      return std::tie(x.high, x.triangle, x.corner) < std::tie(y.high, y.triangle, y.corner);
                  });
    }
    for (std::size_t i = 0; i < table.uses.size(); ++i) {
        if (i == 0 || table.uses[i].low != table.uses[i - 1].low ||
            table.uses[i].high != table.uses[i - 1].high) {
            table.start.push_back(static_cast<int>(i));
        }
    }
    table.start.push_back(static_cast<int>(table.uses.size()));
    return table;
}

Labels edge_components(const Triangles& F, const EdgeTable& edges) {
    DisjointSets sets(static_cast<std::size_t>(F.rows()));
    for (int e = 0; e < edges.edge_count(); ++e) {
        if (edges.use_count(e) == 2) sets.join(edges.use(e, 0).triangle, edges.use(e, 1).triangle);
    }
    return sets.labels();
}

Labels umbrellas(const Triangles& F, const EdgeTable& edges) {
    DisjointSets sets(static_cast<std::size_t>(F.size()));
    for (int e = 0; e < edges.edge_count(); ++e) {
        if (edges.use_count(e) != 2) continue;
        const EdgeUse &x = edges.use(e, 0), &y = edges.use(e, 1);
        for (const int vertex : {x.low, x.high}) sets.join(corner_at(x, vertex), corner_at(y, vertex));
    }
    return sets.labels();
}

int count_boundary_loops(const EdgeTable& edges, const Labels& umbrellas) {
    DisjointSets sets(static_cast<std::size_t>(umbrellas.count));
    std::vector<char> on_border(static_cast<std::size_t>(umbrellas.count), 0);
    for (int e = 0; e < edges.edge_count(); ++e) {
        if (edges.use_count(e) != 1) continue;
        const EdgeUse& use = edges.use(e, 0);
        const int low = umbrellas.of[corner_at(use, use.low)], high = umbrellas.of[corner_at(use, use.high)];
        sets.join(low, high);
        on_border[low] = on_border[high] = 1;
    }
    int loops = 0;
    for (int u = 0; u < umbrellas.count; ++u) loops += on_border[u] && sets.find(u) == u ? 1 : 0;
    return loops;
}

Orientation consistent_orientation(const Triangles& F, const EdgeTable& edges, const Labels& components) {
    const auto faces = static_cast<std::size_t>(F.rows());
    Orientation result;
    result.flip.assign(faces, 0);
    std::vector<int> edge_of_side(3 * faces);
    for (int e = 0; e < edges.edge_count(); ++e) {
        for (int k = 0; k < edges.use_count(e); ++k) {
            edge_of_side[3 * edges.use(e, k).triangle + edges.use(e, k).corner] = e;
        }
    }
    std::vector<char> seen(faces, 0);
    std::vector<int> flipped(components.count, 0), size(components.count, 0), queue;
    for (int first = 0; first < F.rows(); ++first) {
        if (seen[first]) continue;
        seen[first] = 1;
        queue.assign(1, first);
        while (!queue.empty()) {
            const int t = queue.back();
            queue.pop_back();
            ++size[components.of[t]];
            flipped[components.of[t]] += result.flip[t];
            for (int k = 0; k < 3; ++k) {
                const int e = edge_of_side[3 * t + k];
                if (edges.use_count(e) != 2) continue;
                const EdgeUse &x = edges.use(e, 0), &y = edges.use(e, 1);
                const int other = x.triangle == t ? y.triangle : x.triangle;
                const char turn = static_cast<char>(result.flip[t] ^ (x.forward == y.forward ? 1 : 0));
                if (!seen[other]) {
                    seen[other] = 1;
                    result.flip[other] = turn;
                    queue.push_back(other);
                } else if (result.flip[other] != turn && result.conflicting_edge < 0) {
                    result.conflicting_edge = e;
                }
            }
        }
    }
    for (std::size_t t = 0; t < faces; ++t) {
        const int c = components.of[t];
        if (2 * flipped[c] > size[c]) result.flip[t] ^= 1;
    }
    return result;
}

}  // namespace automorph
