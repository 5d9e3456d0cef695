#include "overlay_checks.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <sstream>
#include <vector>

namespace automorph::testing {

namespace {

using Number =
    CGAL::Exact_predicates_exact_constructions_kernel::FT;  // intervals, rational where they do not decide
using ExactRay = std::array<Number, 3>;
using Edge = std::pair<int, int>;

ExactRay exact(const Ray& r) {
    return {Number(r.x()), Number(r.y()), Number(r.z())};
}

ExactRay cross(const ExactRay& a, const ExactRay& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Number dot(const ExactRay& a, const ExactRay& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

int sign(const Number& x) {
    return static_cast<int>(CGAL::sign(x));
}

int turn(const ExactRay& a, const ExactRay& b, const ExactRay& c) {
    return sign(dot(cross(a, b), c));
}

/// True if x, on the great circle (line) through p and q, lies strictly between them.
bool between(const ExactRay& x, const ExactRay& p, const ExactRay& q) {
    const ExactRay n = cross(p, q);
    return sign(dot(cross(p, x), n)) > 0 && sign(dot(cross(x, q), n)) > 0;
}

/// True if x lies strictly inside the arc (segment) from p to q.
bool inside_edge(const ExactRay& x, const ExactRay& p, const ExactRay& q) {
    return turn(p, q, x) == 0 && between(x, p, q);
}

/// One of the two meshes, with what the checks look up.
struct Map {
    const char* name;
    const TestMap& map;
    std::vector<ExactRay> rays;
    std::set<Edge> edges;  ///< directed
    std::map<std::array<int, 3>, int> triangles;

    Map(const char* map_name, const TestMap& test_map) : name(map_name), map(test_map) {
        for (int v = 0; v < map.rays.rows(); ++v) rays.push_back(exact(map.rays.row(v)));
        for (int f = 0; f < map.mesh.triangle_count(); ++f) {
            std::array<int, 3> corners{};
            for (int k = 0; k < 3; ++k) {
                corners[k] = map.mesh.F(f, k);
                edges.emplace(map.mesh.F(f, k), map.mesh.F(f, (k + 1) % 3));
            }
            std::sort(corners.begin(), corners.end());
            triangles[corners] = f;
        }
    }
    bool closed() const {
        return std::all_of(edges.begin(), edges.end(), [&](const Edge& e) {
            return edges.count({e.second, e.first}) > 0;
        });
    }
    bool has(const Site& site) const {
        for (int k = 0; k < site.count; ++k)
            if (site.corners[k] < 0 || site.corners[k] >= map.rays.rows()) return false;
        if (site.count == 1) return true;
        if (site.count == 2)
            return edges.count({site.corners[0], site.corners[1]}) ||
                   edges.count({site.corners[1], site.corners[0]});
        std::array<int, 3> corners = {site.corners[0], site.corners[1], site.corners[2]};
        std::sort(corners.begin(), corners.end());
        return site.count == 3 && triangles.count(corners);
    }
    Ray place(const Site& site) const {
        Ray sum = Ray::Zero();
        for (int k = 0; k < site.count; ++k)
            sum += site.weights[k] * map.rays.row(site.corners[k]).transpose();
        return sum;
    }
};

class Checker {
public:
    Checker(const Overlay& overlay, const TestMap& a, const TestMap& b)
        : overlay_(overlay), a_("a", a), b_("b", b), closed_(a_.closed()) {}

    std::string run() {
        if (check_arrays() && check_sites()) {
            check_vertices_of_inputs();
            check_counts();
            if (check_faces()) {
                check_topology();
                check_areas(a_, overlay_.on_a, overlay_.face_of_a);
                check_areas(b_, overlay_.on_b, overlay_.face_of_b);
                check_paths(a_, overlay_.on_a);
                check_paths(b_, overlay_.on_b);
            }
        }
        if (reports_ > kMostReports) out_ << "... " << reports_ << " violations in all\n";
        return out_.str();
    }

private:
    static constexpr int kMostReports = 10;

    template <typename... Parts>
    void report(const Parts&... parts) {
        if (++reports_ > kMostReports) return;
        ((out_ << parts), ...);
        out_ << '\n';
    }

    bool check_arrays() {
        const std::size_t faces = overlay_.face_of_a.size();
        if (overlay_.on_a.size() != overlay_.on_b.size() || overlay_.face_of_b.size() != faces ||
            overlay_.polygon_start.size() != faces + 1 || overlay_.polygon_start.front() != 0 ||
            overlay_.polygon_start.back() != static_cast<int>(overlay_.polygon_vertices.size()) ||
            !std::is_sorted(overlay_.polygon_start.begin(), overlay_.polygon_start.end()) ||
            overlay_.vertex_of_a.size() != a_.rays.size() || overlay_.vertex_of_b.size() != b_.rays.size())
            report("array sizes do not fit");
        for (const int v : overlay_.polygon_vertices)
            if (v < 0 || v >= overlay_.vertex_count()) report("corner ", v, " out of range");
        for (const int f : overlay_.face_of_a)
            if (f < 0 || f >= a_.map.mesh.triangle_count()) report("face of a ", f, " out of range");
        for (const int f : overlay_.face_of_b)
            if (f < 0 || f >= b_.map.mesh.triangle_count()) report("face of b ", f, " out of range");
        return reports_ == 0;
    }

    void check_weights(const char* name, int v, const Site& site) {
        double sum = 0;
        for (int k = 0; k < site.count; ++k) {
            sum += site.weights[k];
            if (!(site.weights[k] > 0)) report("vertex ", v, ": weight ", site.weights[k], " on ", name);
        }
        if (!(std::abs(sum - 1) < 1e-15 * 4))
            report("vertex ", v, ": weights on ", name, " sum to 1 + ", sum - 1);
        if (site.count == 1 && site.weights[0] != 1.0) report("vertex ", v, ": a vertex of ", name, " moved");
    }

    /// True if the vertex lies where its sites say, by exact signs; sets its exact direction.
    bool exact_place(const Site& a, const Site& b, ExactRay& x) const {
        const auto ra = [&](int k) { return a_.rays[a.corners[k]]; };
        const auto rb = [&](int k) { return b_.rays[b.corners[k]]; };
        if (a.count == 1) {
            x = ra(0);
            if (b.count == 1) {
                const ExactRay n = cross(x, rb(0));
                return sign(n[0]) == 0 && sign(n[1]) == 0 && sign(n[2]) == 0 && sign(dot(x, rb(0))) > 0;
            }
            if (b.count == 2) return inside_edge(x, rb(0), rb(1));
            return inside(x, b_, b);
        }
        if (b.count == 1) {
            x = rb(0);
            if (a.count == 2) return inside_edge(x, ra(0), ra(1));
            return inside(x, a_, a);
        }
        if (a.count != 2 || b.count != 2) return false;
        x = cross(cross(ra(0), ra(1)), cross(rb(0), rb(1)));
        if (sign(dot(cross(ra(0), x), cross(ra(0), ra(1)))) < 0) x = {-x[0], -x[1], -x[2]};
        return between(x, ra(0), ra(1)) && between(x, rb(0), rb(1));  // it is on both circles by construction
    }

    static bool inside(const ExactRay& x, const Map& map, const Site& site) {
        std::array<int, 3> corners = {site.corners[0], site.corners[1], site.corners[2]};
        std::sort(corners.begin(), corners.end());
        const int f = map.triangles.at(corners);
        for (int k = 0; k < 3; ++k)
            if (turn(map.rays[map.map.mesh.F(f, k)], map.rays[map.map.mesh.F(f, (k + 1) % 3)], x) <= 0)
                return false;
        return true;
    }

    bool check_sites() {
        std::set<std::pair<std::vector<int>, std::vector<int>>> places;
        for (int v = 0; v < overlay_.vertex_count(); ++v) {
            const Site &a = overlay_.on_a[v], &b = overlay_.on_b[v];
            if (a.count < 1 || a.count > 3 || b.count < 1 || b.count > 3 || !a_.has(a) || !b_.has(b)) {
                report("vertex ", v, ": its corners are no vertex, edge or triangle");
                return false;
            }
            std::pair place{std::vector<int>(a.corners, a.corners + a.count),
                            std::vector<int>(b.corners, b.corners + b.count)};
            std::sort(place.first.begin(), place.first.end());
            std::sort(place.second.begin(), place.second.end());
            if (!places.insert(place).second) report("vertex ", v, ": another one has the same place");
            check_weights("a", v, a);
            check_weights("b", v, b);
            ExactRay x;
            if (!exact_place(a, b, x)) report("vertex ", v, ": is not where its sites say");
            exact_.push_back(x);
            const Ray on_a = a_.place(a), on_b = b_.place(b);
            if (!(on_a.cross(on_b).norm() <= kPlaceTolerance * on_a.norm() * on_b.norm() &&
                  on_a.dot(on_b) > 0))
                report("vertex ", v, ": its sites are ", on_a.cross(on_b).norm() / on_a.norm() / on_b.norm(),
                       " apart");
        }
        return reports_ == 0;
    }

    void check_vertices_of_inputs() {
        const auto check = [&](const std::vector<int>& vertex_of, const std::vector<Site>& sites,
                               const char* name) {
            for (std::size_t v = 0; v < vertex_of.size(); ++v) {
                const int merged = vertex_of[v];
                if (merged < 0 || merged >= overlay_.vertex_count() || sites[merged].count != 1 ||
                    sites[merged].corners[0] != static_cast<int>(v))
                    report("vertex ", v, " of ", name, " has no merged vertex");
            }
        };
        check(overlay_.vertex_of_a, overlay_.on_a, "a");
        check(overlay_.vertex_of_b, overlay_.on_b, "b");
    }

    void check_counts() {
        int crossings = 0, coincident = 0, on_edges = 0;
        for (int v = 0; v < overlay_.vertex_count(); ++v) {
            const int a = overlay_.on_a[v].count, b = overlay_.on_b[v].count;
            crossings += a == 2 && b == 2;
            coincident += a == 1 && b == 1;
            on_edges += a + b == 3;
        }
        const int expected = static_cast<int>(a_.rays.size() + b_.rays.size()) + crossings - coincident;
        if (overlay_.vertex_count() != expected)
            report(overlay_.vertex_count(), " vertices, N_a + N_b + I_tot - coincident = ", expected);
        if (crossings != overlay_.crossings)
            report(overlay_.crossings, " crossings stated, ", crossings, " there");
        if (coincident != overlay_.coincident)
            report(overlay_.coincident, " coincident stated, ", coincident, " there");
        if (on_edges != overlay_.on_edges)
            report(overlay_.on_edges, " on edges stated, ", on_edges, " there");
    }

    static bool contains(const Map& map, int f, const Site& site) {
        for (int k = 0; k < site.count; ++k) {
            bool found = false;
            for (int j = 0; j < 3; ++j) found = found || map.map.mesh.F(f, j) == site.corners[k];
            if (!found) return false;
        }
        return true;
    }

    bool check_faces() {
        std::set<Edge> pairs;
        for (int f = 0; f < overlay_.face_count(); ++f) {
            const int start = overlay_.polygon_start[f], count = overlay_.polygon_start[f + 1] - start;
            const int fa = overlay_.face_of_a[f], fb = overlay_.face_of_b[f];
            if (!pairs.emplace(fa, fb).second)
                report("triangles ", fa, " and ", fb, " have two merged faces");
            if (count < 3 || count > 6) report("face ", f, " has ", count, " corners");
            for (int k = 0; k < count; ++k) {
                const auto corner = [&](int j) { return overlay_.polygon_vertices[start + (k + j) % count]; };
                if (!contains(a_, fa, overlay_.on_a[corner(0)]) ||
                    !contains(b_, fb, overlay_.on_b[corner(0)]))
                    report("face ", f, ": corner ", corner(0), " lies outside its triangles");
                if (turn(exact_[corner(0)], exact_[corner(1)], exact_[corner(2)]) <= 0)
                    report("face ", f, ": no left turn at corner ", corner(1));
            }
        }
        return reports_ == 0;
    }

    void check_topology() {
        std::vector<int> component(overlay_.on_a.size());
        std::iota(component.begin(), component.end(), 0);
        const auto root = [&](int v) {
            while (component[v] != v) v = component[v] = component[component[v]];
            return v;
        };
        for (int f = 0; f < overlay_.face_count(); ++f) {
            const int start = overlay_.polygon_start[f], end = overlay_.polygon_start[f + 1];
            for (int k = start; k < end; ++k) {
                const int from = overlay_.polygon_vertices[k];
                const int to = overlay_.polygon_vertices[k + 1 < end ? k + 1 : start];
                if (!merged_edges_.emplace(from, to).second)
                    report("edge ", from, " ", to, " bounds two faces on one side");
                component[root(from)] = root(to);
            }
        }
        int open_sides = 0, components = 0;
        for (const auto& [from, to] : merged_edges_) {
            if (merged_edges_.count({to, from})) continue;
            ++open_sides;
            if (!on_border(a_, overlay_.on_a[from], overlay_.on_a[to]) ||
                !on_border(b_, overlay_.on_b[from], overlay_.on_b[to]))
                report("edge ", from, " ", to, " has a face on one side only, inside the domain");
        }
        for (int v = 0; v < overlay_.vertex_count(); ++v) components += root(v) == v;
        const int edges = (static_cast<int>(merged_edges_.size()) + open_sides) / 2;
        const int euler = overlay_.vertex_count() - edges + overlay_.face_count();
        if (components != 1) report(components, " components");
        if (euler != (closed_ ? 2 : 1)) report("Euler characteristic ", euler);
    }

    /// Both sites lie on one border edge, run through in the direction of the border.
    static bool on_border(const Map& map, const Site& from, const Site& to) {
        std::set<int> corners(from.corners, from.corners + from.count);
        corners.insert(to.corners, to.corners + to.count);
        if (corners.size() != 2) return false;
        const int u = *corners.begin(), v = *corners.rbegin();
        return map.edges.count({u, v}) != map.edges.count({v, u});
    }

    /// Area in the plane z = 1, solid angle on the sphere, of a fan round the first corner.
    double area(const std::vector<Ray>& polygon) const {
        double sum = 0;
        for (std::size_t k = 2; k < polygon.size(); ++k) {
            const Ray &p = polygon[0], &q = polygon[k - 1], &r = polygon[k];
            if (closed_) {
                const Ray x = p.normalized(), y = q.normalized(), z = r.normalized();
                sum += 2 * std::atan2(x.cross(y).dot(z), 1 + x.dot(y) + y.dot(z) + z.dot(x));
            } else {
                const Eigen::Vector2d u = (q / q.z() - p / p.z()).head<2>(),
                                      v = (r / r.z() - p / p.z()).head<2>();
                sum += 0.5 * (u.x() * v.y() - u.y() * v.x());
            }
        }
        return sum;
    }

    void check_areas(const Map& map, const std::vector<Site>& sites, const std::vector<int>& face_of) {
        std::vector<double> pieces(static_cast<std::size_t>(map.map.mesh.triangle_count()), 0.0);
        double total = 0, domain = 0;
        for (int f = 0; f < overlay_.face_count(); ++f) {
            std::vector<Ray> polygon;
            for (int k = overlay_.polygon_start[f]; k < overlay_.polygon_start[f + 1]; ++k)
                polygon.push_back(map.place(sites[overlay_.polygon_vertices[k]]));
            const double piece = area(polygon);
            pieces[face_of[f]] += piece;
            total += piece;
        }
        for (int f = 0; f < map.map.mesh.triangle_count(); ++f) {
            std::vector<Ray> corners;
            for (int k = 0; k < 3; ++k) corners.push_back(map.map.rays.row(map.map.mesh.F(f, k)));
            const double whole = area(corners);
            domain += whole;
            if (!(std::abs(pieces[f] - whole) <= 1e-12 * extent()))
                report("triangle ", f, " of ", map.name, " has area ", whole, ", its pieces ", pieces[f]);
        }
        if (closed_) domain = 4 * std::numbers::pi;
        if (!(std::abs(total - domain) <= 1e-11 * extent()))
            report("the merged faces have area ", total, " in a domain of ", domain);
    }

    /// What rounding of an area is relative to: the square of the largest coordinate in the plane, 1 on the
    /// sphere.
    double extent() const {
        if (closed_) return 1.0;
        double largest = 0;
        for (int v = 0; v < a_.map.rays.rows(); ++v)
            largest = std::max(largest, a_.map.rays.row(v).head<2>().norm() / a_.map.rays(v, 2));
        return largest * largest;
    }

    void check_paths(const Map& map, const std::vector<Site>& sites) {
        std::map<Edge, std::vector<int>> inner;
        for (int v = 0; v < overlay_.vertex_count(); ++v)
            if (sites[v].count == 2)
                inner[std::minmax(sites[v].corners[0], sites[v].corners[1])].push_back(v);
        const std::vector<int>& vertex_of = &map == &a_ ? overlay_.vertex_of_a : overlay_.vertex_of_b;
        for (const auto& [u, v] : map.edges) {
            if (u > v && map.edges.count({v, u})) continue;
            std::vector<int> path = inner[std::minmax(u, v)];
            const ExactRay normal = cross(map.rays[u], map.rays[v]);
            std::sort(path.begin(), path.end(),
                      [&](int x, int y) { return sign(dot(cross(exact_[x], exact_[y]), normal)) > 0; });
            path.insert(path.begin(), vertex_of[u]);
            path.push_back(vertex_of[v]);
            for (std::size_t k = 0; k + 1 < path.size(); ++k)
                if (!merged_edges_.count({path[k], path[k + 1]}) &&
                    !merged_edges_.count({path[k + 1], path[k]}))
                    report("edge ", u, " ", v, " of ", map.name, " is broken between merged vertices ",
                           path[k], " and ", path[k + 1]);
        }
    }

    const Overlay& overlay_;
    Map a_, b_;
    bool closed_;
    std::vector<ExactRay> exact_;  ///< direction of each merged vertex
    std::set<Edge> merged_edges_;  ///< directed
    std::ostringstream out_;
    int reports_ = 0;
};

}  // namespace

std::string violations(const Overlay& overlay, const TestMap& a, const TestMap& b) {
    return Checker(overlay, a, b).run();
}

}  // namespace automorph::testing
