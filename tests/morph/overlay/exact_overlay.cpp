#include "exact_overlay.h"

#include <CGAL/Exact_integer.h>
#include <CGAL/Exact_rational.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>

namespace automorph::testing {

namespace {

// Rays are scaled by one power of two to integers: directions and barycentric coordinates do not change.
using Integer = CGAL::Exact_integer;
using IntegerRay = std::array<Integer, 3>;
using Corners = std::vector<int>;           ///< sorted mesh vertices: 1 vertex, 2 edge, 3 triangle
using Place = std::pair<Corners, Corners>;  ///< on a, on b
using FacePair = std::pair<int, int>;

/// One ray per direction: coordinates without a common divisor.
IntegerRay normalised(const IntegerRay& r) {
    const Integer divisor = CGAL::abs(CGAL::gcd(CGAL::gcd(r[0], r[1]), r[2]));
    if (divisor == 0) throw std::logic_error("a zero ray");
    return {CGAL::integral_division(r[0], divisor), CGAL::integral_division(r[1], divisor),
            CGAL::integral_division(r[2], divisor)};
}

Integer det(const IntegerRay& a, const IntegerRay& b, const IntegerRay& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// x = mantissa 2^exponent with an odd mantissa; 0 = 0 * 2^0.
struct Binary {
    long long mantissa;
    int exponent;
};

Binary binary(double x) {
    if (x == 0) return {0, 0};
    int exponent = 0;
    auto mantissa = static_cast<long long>(std::ldexp(std::frexp(x, &exponent), 53));
    exponent -= 53;
    for (; mantissa % 2 == 0; ++exponent) mantissa /= 2;
    return {mantissa, exponent};
}

int least_exponent(const Points& rays) {
    int least = 0;
    for (int k = 0; k < rays.size(); ++k) least = std::min(least, binary(rays.data()[k]).exponent);
    return least;
}

Integer power_of_two(int exponent) {
    Integer power(1);
    for (; exponent >= 16; exponent -= 16) power *= Integer(1 << 16);
    return power * Integer(1 << exponent);
}

/// The rays times 2^-least_exponent.
std::vector<IntegerRay> exact_rays(const Points& rays, int least_exponent) {
    std::vector<IntegerRay> exact;
    for (int v = 0; v < rays.rows(); ++v) {
        IntegerRay ray;
        for (int k = 0; k < 3; ++k) {
            const Binary x = binary(rays(v, k));
            const Integer high(static_cast<int>(x.mantissa / (1 << 27))),
                low(static_cast<int>(x.mantissa % (1 << 27)));
            ray[k] = (high * Integer(1 << 27) + low) * power_of_two(x.exponent - least_exponent);
        }
        exact.push_back(ray);
    }
    return exact;
}

/// The part of the cone `polygon` on the left of the plane through p and q.
std::vector<IntegerRay> clipped(const std::vector<IntegerRay>& polygon, const IntegerRay& p,
                                const IntegerRay& q) {
    std::vector<Integer> side;
    for (const IntegerRay& x : polygon) side.push_back(det(p, q, x));
    std::vector<IntegerRay> kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const std::size_t next = (k + 1) % polygon.size();
        const IntegerRay &x = polygon[k], &y = polygon[next];
        if (side[k] >= 0) kept.push_back(x);
        if ((side[k] > 0 && side[next] < 0) || (side[k] < 0 && side[next] > 0)) {
            const Integer wx = CGAL::abs(side[next]), wy = CGAL::abs(side[k]);
            kept.push_back(normalised({wx * x[0] + wy * y[0], wx * x[1] + wy * y[1], wx * x[2] + wy * y[2]}));
        }
    }
    return kept;
}

struct ExactMap {
    const TestMap& map;
    std::vector<IntegerRay> rays;
    std::array<IntegerRay, 3> corners(int f) const {
        return {rays[map.mesh.F(f, 0)], rays[map.mesh.F(f, 1)], rays[map.mesh.F(f, 2)]};
    }
};

/// Sign of det[a b c]: in doubles where that is beyond doubt, else in rationals.
int sign(const ExactMap& x, int a, int b, const ExactMap& y, int c) {
    const Ray p = x.map.rays.row(a), q = x.map.rays.row(b), r = y.map.rays.row(c);
    const double value = p.cross(q).dot(r);
    if (std::abs(value) > 1e-12 * p.lpNorm<1>() * q.lpNorm<1>() * r.lpNorm<1>()) return value > 0 ? 1 : -1;
    const Integer exact = det(x.rays[a], x.rays[b], y.rays[c]);
    return exact > 0 ? 1 : exact < 0 ? -1 : 0;
}

/// True if an edge of `x` has all of `y` on its right or on it: the interiors do not meet. A filter only.
bool separated(const ExactMap& x, int fx, const ExactMap& y, int fy) {
    for (int k = 0; k < 3; ++k) {
        const int p = x.map.mesh.F(fx, k), q = x.map.mesh.F(fx, (k + 1) % 3);
        bool outside = true;
        for (int j = 0; j < 3 && outside; ++j) outside = sign(x, p, q, y, y.map.mesh.F(fy, j)) <= 0;
        if (outside) return true;
    }
    return false;
}

/// The corners whose barycentric coordinate is not zero, sorted. @pre x lies in the closed cone
Corners corners(const ExactMap& map, int f, const IntegerRay& x) {
    const auto r = map.corners(f);
    Corners result;
    for (int k = 0; k < 3; ++k) {
        const Integer weight = det(x, r[(k + 1) % 3], r[(k + 2) % 3]);
        if (weight < 0) throw std::logic_error("a clipped corner lies outside its triangle");
        if (weight > 0) result.push_back(map.map.mesh.F(f, k));
    }
    std::sort(result.begin(), result.end());
    return result;
}

/// Barycentric coordinates in the flat triangle of the rays, rounded. @pre x lies in the closed cone
Site site(const ExactMap& map, int f, const IntegerRay& x) {
    const auto r = map.corners(f);
    const std::array<Integer, 3> w = {det(x, r[1], r[2]), det(x, r[2], r[0]), det(x, r[0], r[1])};
    const Integer sum = w[0] + w[1] + w[2];
    Site site;
    for (int k = 0; k < 3; ++k) {
        if (w[k] == 0) continue;
        site.corners[site.count] = map.map.mesh.F(f, k);
        site.weights[site.count++] = CGAL::to_double(CGAL::Exact_rational(w[k], sum));
    }
    return site;
}

Corners corners(const Site& site) {
    Corners result(site.corners, site.corners + site.count);
    std::sort(result.begin(), result.end());
    return result;
}

Place place(const Overlay& overlay, int v) {
    return {corners(overlay.on_a[v]), corners(overlay.on_b[v])};
}

/// Collects merged vertices; a direction and a place in the meshes must name the same one.
struct Vertices {
    Overlay& overlay;
    std::map<IntegerRay, int> by_direction;
    std::map<Place, int> by_place;

    int add(const IntegerRay& x, const ExactMap& a, int fa, const ExactMap& b, int fb) {
        const auto [at, fresh] = by_direction.try_emplace(x, overlay.vertex_count());
        const auto [same, fresh_place] =
            by_place.try_emplace(Place(corners(a, fa, x), corners(b, fb, x)), at->second);
        if (fresh != fresh_place || same->second != at->second)
            throw std::logic_error("a direction with two places in the meshes: a map is not one-to-one");
        if (fresh) add_site(at->second, site(a, fa, x), site(b, fb, x));
        return at->second;
    }

    void add_site(int vertex, const Site& on_a, const Site& on_b) {
        overlay.on_a.push_back(on_a);
        overlay.on_b.push_back(on_b);
        if (on_a.count == 1) overlay.vertex_of_a[on_a.corners[0]] = vertex;
        if (on_b.count == 1) overlay.vertex_of_b[on_b.corners[0]] = vertex;
        overlay.crossings += on_a.count == 2 && on_b.count == 2;
        overlay.coincident += on_a.count == 1 && on_b.count == 1;
        overlay.on_edges += on_a.count + on_b.count == 3;
    }
};

}  // namespace

Overlay exact_overlay(const TestMap& a, const TestMap& b) {
    const int exponent = std::min(least_exponent(a.rays), least_exponent(b.rays));
    const ExactMap map_a{a, exact_rays(a.rays, exponent)}, map_b{b, exact_rays(b.rays, exponent)};
    Overlay overlay;
    overlay.vertex_of_a.assign(a.rays.rows(), -1);
    overlay.vertex_of_b.assign(b.rays.rows(), -1);
    overlay.polygon_start.push_back(0);
    Vertices vertices{overlay, {}, {}};
    for (int fa = 0; fa < a.mesh.triangle_count(); ++fa) {
        for (int fb = 0; fb < b.mesh.triangle_count(); ++fb) {
            if (separated(map_a, fa, map_b, fb) || separated(map_b, fb, map_a, fa)) continue;
            const auto of_a = map_a.corners(fa), of_b = map_b.corners(fb);
            std::vector<IntegerRay> polygon;
            for (const IntegerRay& r : of_a) polygon.push_back(normalised(r));
            for (int k = 0; k < 3; ++k) polygon = clipped(polygon, of_b[k], of_b[(k + 1) % 3]);
            if (polygon.size() < 3) continue;
            for (const IntegerRay& x : polygon)
                overlay.polygon_vertices.push_back(vertices.add(x, map_a, fa, map_b, fb));
            overlay.polygon_start.push_back(static_cast<int>(overlay.polygon_vertices.size()));
            overlay.face_of_a.push_back(fa);
            overlay.face_of_b.push_back(fb);
        }
    }
    return overlay;
}

namespace {

/// The faces with their corners as places, each cycle starting at its smallest place.
std::map<FacePair, std::vector<Place>> face_cycles(const Overlay& overlay) {
    std::map<FacePair, std::vector<Place>> faces;
    for (int f = 0; f < overlay.face_count(); ++f) {
        std::vector<Place> cycle;
        for (int k = overlay.polygon_start[f]; k < overlay.polygon_start[f + 1]; ++k)
            cycle.push_back(place(overlay, overlay.polygon_vertices[k]));
        std::rotate(cycle.begin(), std::min_element(cycle.begin(), cycle.end()), cycle.end());
        faces[{overlay.face_of_a[f], overlay.face_of_b[f]}] = cycle;
    }
    return faces;
}

std::string text(const Place& place) {
    std::ostringstream out;
    out << "a(";
    for (const int v : place.first) out << ' ' << v;
    out << " ) b(";
    for (const int v : place.second) out << ' ' << v;
    out << " )";
    return out.str();
}

/// Largest relative difference of the weights of two sites with the same corners.
double weight_error(const Site& found, const Site& expected) {
    double error = 0;
    for (int k = 0; k < found.count; ++k)
        for (int j = 0; j < expected.count; ++j)
            if (found.corners[k] == expected.corners[j])
                error =
                    std::max(error, std::abs(found.weights[k] - expected.weights[j]) / expected.weights[j]);
    return error;
}

}  // namespace

std::string difference(const Overlay& found, const Overlay& expected) {
    std::ostringstream out;
    const auto count = [&](const char* what, int is, int should) {
        if (is != should) out << what << ": " << is << " instead of " << should << '\n';
    };
    count("merged vertices", found.vertex_count(), expected.vertex_count());
    count("merged faces", found.face_count(), expected.face_count());
    count("crossings", found.crossings, expected.crossings);
    count("coincident", found.coincident, expected.coincident);
    count("on edges", found.on_edges, expected.on_edges);

    int reports = 0;
    std::map<Place, int> missing;
    for (int v = 0; v < expected.vertex_count(); ++v) missing[place(expected, v)] = v;
    for (int v = 0; v < found.vertex_count(); ++v) {
        const auto at = missing.find(place(found, v));
        if (at == missing.end()) {
            if (++reports < 10)
                out << "unexpected or double vertex " << v << " at " << text(place(found, v)) << '\n';
            continue;
        }
        const double error = std::max(weight_error(found.on_a[v], expected.on_a[at->second]),
                                      weight_error(found.on_b[v], expected.on_b[at->second]));
        if (!(error <= kWeightTolerance) && ++reports < 10)
            out << "weights of vertex " << v << " at " << text(at->first) << " are off by " << error << '\n';
        missing.erase(at);
    }
    for (const auto& [at, v] : missing)
        if (++reports < 10) out << "missing vertex at " << text(at) << '\n';

    const auto faces = face_cycles(found), wanted = face_cycles(expected);
    for (const auto& [pair, cycle] : wanted) {
        const auto at = faces.find(pair);
        if (at != faces.end() && at->second == cycle) continue;
        if (++reports >= 10) continue;
        out << "face (" << pair.first << ", " << pair.second << ") should be";
        for (const Place& corner : cycle) out << "  " << text(corner);
        out << (at == faces.end() ? "; is missing" : "; is");
        if (at != faces.end())
            for (const Place& corner : at->second) out << "  " << text(corner);
        out << '\n';
    }
    for (const auto& [pair, cycle] : faces)
        if (!wanted.count(pair) && ++reports < 10)
            out << "unexpected face (" << pair.first << ", " << pair.second << ")\n";
    return out.str();
}

}  // namespace automorph::testing
