#include "morph/parameterization/decimation.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <queue>

#include "morph/mesh/errors.h"
#include "morph/mesh/index.h"

// Notation: v is the vertex that goes, u the neighbour it goes to; w_k are the neighbours of v,
// counter-clockwise.

namespace automorph {

namespace {

using Eigen::Vector3d;

/// Share of |u - v|^2 times area in the cost: enough to even out flat parts, too little to give up features.
constexpr double kEvenness = 1e-2;
/// Weight of area that turns over, against the plain distance.
constexpr double kTurnedOver = 1.0;
/// Cosine below which a triangle counts as turned over.
constexpr double kTurnedCosine = 0.2;
/// Cost of a collapse of no length, in units of the sphere: with it the valence counts there too.
constexpr double kLeastCost = 1e-12;
/// Valence from which on a collapse gets dearer.
constexpr int kHighValence = 8;
/// Vertices of higher valence wait until their neighbours have gone; the detailed cost is quadratic in it.
constexpr int kWaits = 20;
constexpr double kWaitingCost = 1e6;

/// Area-weighted squared distance from planes [Garland97]: the upper triangle of the 4 x 4 matrix.
using Quadric = std::array<double, 10>;

void add_plane(Quadric& q, const Vector3d& n, double d, double weight) {
    const double x[4] = {n.x(), n.y(), n.z(), d};
    std::size_t k = 0;
    for (int i = 0; i < 4; ++i) {
        for (int j = i; j < 4; ++j) q[k++] += weight * x[i] * x[j];
    }
}

double value(const Quadric& q, const Vector3d& p) {
    const double x = p.x(), y = p.y(), z = p.z();
    return x * (q[0] * x + 2 * (q[1] * y + q[2] * z + q[3])) + y * (q[4] * y + 2 * (q[5] * z + q[6])) +
           z * (q[7] * z + 2 * q[8]) + q[9];
}

class Decimation {
public:
    Decimation(HalfEdges& mesh, const Points& V, const std::vector<char>& fixed)
        : mesh_(mesh), V_(V), fixed_(fixed), quadrics_(at(vertices()), Quadric{}), vertices_(at(vertices())) {
        stamp_.assign(at(vertices()), 0);
        for (int h = 0; h < static_cast<int>(mesh_.origin.size()); h += 4) {
            const Vector3d p = place(mesh_.origin[at(h)]);
            const Vector3d n = (place(mesh_.origin[at(h + 1)]) - p).cross(place(mesh_.origin[at(h + 2)]) - p);
            const double doubled = n.norm();
            if (!(doubled > 0.0)) continue;
            const Vector3d unit = n / doubled;
            for (int k = 0; k < 3; ++k) {
                add_plane(quadrics_[at(mesh_.origin[at(h + k)])], unit, -unit.dot(p), 0.5 * doubled);
            }
        }
    }

    std::vector<int> run(int leave) {
        const auto stays = static_cast<int>(std::count(fixed_.begin(), fixed_.end(), 1));
        int left = vertices() - stays;
        const int base = std::max(leave, stays > 0 ? 1 : 4);
        std::vector<int> collapses;
        collapses.reserve(at(std::max(0, left - base)));
        for (int v = 0; v < vertices(); ++v) {
            if (fixed_.empty() || !fixed_[at(v)]) evaluate_and_push(v);
        }
        while (left > base) {
            if (queue_.empty()) {
                if (leave > 0) break;
                throw SolverFailure(fmt::format(
                    "progressive sphere map: no edge can be collapsed at {} vertices; the mesh is no sphere",
                    left));
            }
            const Entry top = queue_.top();
            queue_.pop();
            Vertex& vertex = vertices_[at(top.v)];
            if (!vertex.queued || top.serial != vertex.serial) continue;
            if (vertex.dirty) {
                evaluate_and_push(top.v);
                continue;
            }
            collapses.push_back(vertex.collapse);
            collapse(top.v, vertex.collapse);
            --left;
        }
        return collapses;
    }

private:
    struct Vertex {
        int collapse = -1;  ///< best half-edge
        std::uint32_t serial = 0;
        bool queued = false, dirty = false;
    };
    struct Entry {
        double cost;
        int v;
        std::uint32_t serial;
        bool operator<(const Entry& other) const {  // std::priority_queue has the largest on top
            return cost != other.cost ? cost > other.cost : v > other.v;
        }
    };

    int vertices() const { return static_cast<int>(V_.rows()); }
    Vector3d place(int v) const { return V_.row(v); }
    bool is_fixed(int v) const { return !fixed_.empty() && fixed_[at(v)]; }

    void evaluate_and_push(int v) {
        Vertex& vertex = vertices_[at(v)];
        const double cost = evaluate(v, vertex.collapse);
        vertex.dirty = false;
        vertex.queued = vertex.collapse >= 0;
        ++vertex.serial;
        if (vertex.queued) queue_.push({cost, v, vertex.serial});
    }

    /// The best collapse of v and its cost; -1 if none is possible.
    double evaluate(int v, int& best) {
        gather(v);
        best = -1;
        double lowest = 0.0;
        for (std::size_t k = 0; k < ring_.size(); ++k) {
            const double cost = cost_of(v, k);
            if ((best >= 0 && cost >= lowest) || !possible(k)) continue;
            lowest = cost;
            best = ring_[k].halfedge;
        }
        return lowest;
    }

    void gather(int v) {
        ring_.clear();
        ++now_;
        const int first = mesh_.out[at(v)];
        int h = first;
        do {
            const int w = mesh_.target(h);
            ring_.push_back({h, w, place(w), Vector3d::Zero()});
            stamp_[at(w)] = now_;
            h = mesh_.turn(h);
        } while (h != first);
        valences_ = 0;
        for (const Neighbour& w : ring_) valences_ += mesh_.valence[at(w.vertex)];
        const Vector3d p = place(v);
        for (std::size_t k = 0; k < ring_.size(); ++k) {
            const Neighbour& following = ring_[k + 1 < ring_.size() ? k + 1 : 0];
            ring_[k].doubled_area = (ring_[k].place - p).cross(following.place - p);
        }
    }

    /// Link condition: the neighbours of w_k among the w are its two neighbours in the ring. With a border,
    /// no new edge may join two border vertices.
    bool possible(std::size_t k) const {
        const std::size_t n = ring_.size();
        const int u = ring_[k].vertex, r = ring_[(k + 1) % n].vertex, l = ring_[(k + n - 1) % n].vertex;
        if (is_fixed(u)) {
            for (const Neighbour& w : ring_) {
                if (is_fixed(w.vertex) && w.vertex != u && w.vertex != r && w.vertex != l) return false;
            }
        }
        if (2 * mesh_.valence[at(u)] <= valences_) {
            int common = 0, h = mesh_.out[at(u)];
            for (int j = 0; j < mesh_.valence[at(u)]; ++j, h = mesh_.turn(h)) {
                common += stamp_[at(mesh_.target(h))] == now_;
            }
            return common == 2;
        }
        // u has more neighbours than all others together: ask those.
        for (const Neighbour& w : ring_) {
            if (w.vertex == u || w.vertex == r || w.vertex == l) continue;
            int h = mesh_.out[at(w.vertex)];
            for (int j = 0; j < mesh_.valence[at(w.vertex)]; ++j, h = mesh_.turn(h)) {
                if (mesh_.target(h) == u) return false;
            }
        }
        return true;
    }

    double cost_of(int v, std::size_t k) const {
        const std::size_t n = ring_.size();
        const Neighbour& u = ring_[k];
        const double squared_length = (u.place - place(v)).squaredNorm();
        const int valence = mesh_.valence[at(u.vertex)] + static_cast<int>(n) - 4;
        const double too_many = std::max(0, valence - kHighValence);
        const double factor = 1.0 + 0.25 * too_many * too_many;
        if (n > kWaits) return (kLeastCost + squared_length) * factor * kWaitingCost;

        double area = 0.0, turned = 0.0;
        for (std::size_t j = 0; j < n; ++j) {
            const std::size_t following = j + 1 < n ? j + 1 : 0;
            const double before = ring_[j].doubled_area.norm();
            area += before;
            if (j == k || following == k) continue;
            const Vector3d after = (ring_[j].place - u.place).cross(ring_[following].place - u.place);
            const double size = after.norm();
            if (after.dot(ring_[j].doubled_area) < kTurnedCosine * size * before) turned += size;
        }
        const double distance = std::max(0.0, value(quadrics_[at(v)], u.place));
        return (distance + kLeastCost + squared_length * (kEvenness * area + kTurnedOver * turned)) * factor;
    }

    void collapse(int v, int h) {
        const int u = mesh_.target(h);
        vertices_[at(v)].queued = false;
        for (std::size_t k = 0; k < quadrics_[at(u)].size(); ++k) quadrics_[at(u)][k] += quadrics_[at(v)][k];
        mesh_.collapse(h);
        touch(u);
        int x = mesh_.out[at(u)];
        for (int j = 0; j < mesh_.valence[at(u)]; ++j, x = mesh_.turn(x)) touch(mesh_.target(x));
    }

    /// A vertex whose star has changed: what could not go may go now, the others wait for their turn.
    void touch(int v) {
        if (is_fixed(v)) return;
        if (vertices_[at(v)].queued) {
            vertices_[at(v)].dirty = true;
        } else {
            evaluate_and_push(v);
        }
    }

    struct Neighbour {
        int halfedge, vertex;
        Vector3d place, doubled_area;  ///< area vector of the triangle v, w_k, w_k+1, times 2
    };

    HalfEdges& mesh_;
    const Points& V_;
    const std::vector<char>& fixed_;
    std::vector<Quadric> quadrics_;
    std::vector<Vertex> vertices_;
    std::priority_queue<Entry> queue_;
    int valences_ = 0;                  ///< sum over ring_
    std::vector<Neighbour> ring_;       ///< of the vertex looked at
    std::vector<std::uint32_t> stamp_;  ///< per vertex: when it was last in ring_
    std::uint32_t now_ = 0;
};

}  // namespace

std::vector<int> decimate(HalfEdges& mesh, const Points& V, const std::vector<char>& fixed, int leave) {
    return Decimation(mesh, V, fixed).run(leave);
}

}  // namespace automorph
