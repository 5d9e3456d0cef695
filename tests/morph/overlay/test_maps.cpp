#include "test_maps.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace automorph::testing {

int Random::below(int count) {
    return static_cast<int>(engine_() % static_cast<std::uint64_t>(count));
}

double Random::uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1.0p-53);
}

Ray Random::direction() {
    for (;;) {
        const double x = uniform(-1, 1), y = uniform(-1, 1), z = uniform(-1, 1);
        const Ray p(x, y, z);
        if (p.squaredNorm() > 0.01 && p.squaredNorm() <= 1.0) return p.normalized();
    }
}

MapBuilder::MapBuilder(const std::vector<Ray>& rays, const Triangles& F) : rays_(rays) {
    for (std::size_t v = 0; v < rays.size(); ++v) topology_.new_vertex();
    for (int f = 0; f < F.rows(); ++f) {
        if (orientation(rays[F(f, 0)], rays[F(f, 1)], rays[F(f, 2)]) <= 0)
            throw std::logic_error("a first triangle of the map is not positive");
        topology_.add_face(OpenMesh::VertexHandle(F(f, 0)), OpenMesh::VertexHandle(F(f, 1)),
                           OpenMesh::VertexHandle(F(f, 2)));
    }
    for (const auto edge : topology_.edges()) planar_ = planar_ || topology_.is_boundary(edge);
}

OpenMesh::FaceHandle MapBuilder::locate(const Ray& p) {
    // A walk towards p; its edges in random order, so that it ends in any triangulation.
    OpenMesh::FaceHandle face = last_;
    for (std::size_t step = 0; step < 20 * topology_.n_faces() + 100; ++step) {
        auto h = topology_.halfedge_handle(face);
        for (int turn = turns_.below(3); turn > 0; --turn) h = topology_.next_halfedge_handle(h);
        bool inside = true;
        for (int k = 0; k < 3 && inside; ++k, h = topology_.next_halfedge_handle(h)) {
            if (orientation(ray(topology_.from_vertex_handle(h)), ray(topology_.to_vertex_handle(h)), p) >= 0)
                continue;
            inside = false;
            face = topology_.opposite_face_handle(h);
            if (!face.is_valid()) return face;
        }
        if (inside) return last_ = face;
    }
    throw std::logic_error("the walk did not end");
}

bool MapBuilder::insert(const Ray& p) {
    const OpenMesh::FaceHandle face = locate(p);
    if (!face.is_valid()) return false;
    int zeros = 0;
    OpenMesh::HalfedgeHandle on;
    auto h = topology_.halfedge_handle(face);
    for (int k = 0; k < 3; ++k, h = topology_.next_halfedge_handle(h)) {
        if (orientation(ray(topology_.from_vertex_handle(h)), ray(topology_.to_vertex_handle(h)), p) != 0)
            continue;
        ++zeros;
        on = h;
    }
    if (zeros > 1) return false;
    if (zeros == 1) {
        const auto edge = topology_.edge_handle(on);
        if (topology_.is_boundary(edge)) return false;
        const auto v = topology_.new_vertex();
        rays_.push_back(p);
        topology_.split(edge, v);
    } else {
        const auto v = topology_.new_vertex();
        rays_.push_back(p);
        topology_.split(face, v);
    }
    return true;
}

bool MapBuilder::flip_if_convex(OpenMesh::EdgeHandle edge) {
    if (topology_.is_boundary(edge) || !topology_.is_flip_ok(edge)) return false;
    const auto h = topology_.halfedge_handle(edge, 0), o = topology_.halfedge_handle(edge, 1);
    const Ray& from = ray(topology_.from_vertex_handle(h));
    const Ray& to = ray(topology_.to_vertex_handle(h));
    const Ray& left = ray(topology_.to_vertex_handle(topology_.next_halfedge_handle(h)));
    const Ray& right = ray(topology_.to_vertex_handle(topology_.next_halfedge_handle(o)));
    if (orientation(from, right, left) <= 0 || orientation(right, to, left) <= 0) return false;
    topology_.flip(edge);
    return true;
}

int MapBuilder::flip(int attempts, Random& random) {
    int flips = 0;
    for (int k = 0; k < attempts; ++k)
        flips += flip_if_convex(OpenMesh::EdgeHandle(random.below(static_cast<int>(topology_.n_edges()))));
    return flips;
}

bool MapBuilder::delaunay(OpenMesh::HalfedgeHandle h) const {
    // The hull is convex at the edge: of the points themselves on the sphere, lifted to a paraboloid in the
    // plane.
    const auto lift = [&](OpenMesh::VertexHandle v) -> Eigen::Vector3d {
        const Ray& r = ray(v);
        if (!planar_) return r.normalized();
        const double x = r.x() / r.z(), y = r.y() / r.z();
        return {x, y, -(x * x + y * y)};
    };
    const auto a = lift(topology_.from_vertex_handle(h)), b = lift(topology_.to_vertex_handle(h));
    const auto c = lift(topology_.to_vertex_handle(topology_.next_halfedge_handle(h)));
    const auto o = topology_.opposite_halfedge_handle(h);
    const auto d = lift(topology_.to_vertex_handle(topology_.next_halfedge_handle(o)));
    const Eigen::Vector3d n = (b - a).cross(c - a);
    return n.dot(d - a) <= 1e-13 * n.norm() * (d - a).norm();
}

void MapBuilder::make_delaunay() {
    std::vector<OpenMesh::EdgeHandle> queue;
    for (const auto edge : topology_.edges()) queue.push_back(edge);
    std::size_t flips = 0;
    while (!queue.empty() && flips < 50 * topology_.n_edges()) {
        const auto edge = queue.back();
        queue.pop_back();
        if (topology_.is_boundary(edge)) continue;
        const auto h = topology_.halfedge_handle(edge, 0), o = topology_.halfedge_handle(edge, 1);
        if (delaunay(h)) continue;
        const auto around = {topology_.next_halfedge_handle(h), topology_.prev_halfedge_handle(h),
                             topology_.next_halfedge_handle(o), topology_.prev_halfedge_handle(o)};
        if (!flip_if_convex(edge)) continue;
        ++flips;
        for (const auto side : around) queue.push_back(topology_.edge_handle(side));
    }
}

TestMap MapBuilder::map() const {
    TestMap map;
    map.rays.resize(static_cast<Eigen::Index>(rays_.size()), 3);
    for (std::size_t v = 0; v < rays_.size(); ++v) map.rays.row(static_cast<Eigen::Index>(v)) = rays_[v];
    map.mesh.V = map.rays;
    map.mesh.F.resize(static_cast<Eigen::Index>(topology_.n_faces()), 3);
    for (const auto f : topology_.faces()) {
        int k = 0;
        for (const auto v : topology_.fv_range(f)) map.mesh.F(f.idx(), k++) = v.idx();
    }
    return map;
}

namespace {

std::vector<int> shuffled(int count, Random& random) {
    std::vector<int> order(static_cast<std::size_t>(count));
    std::iota(order.begin(), order.end(), 0);
    for (int k = count - 1; k > 0; --k) std::swap(order[k], order[random.below(k + 1)]);
    return order;
}

}  // namespace

TestMap renumbered(const TestMap& map, Random& random) {
    const std::vector<int> vertex = shuffled(map.mesh.vertex_count(), random);
    const std::vector<int> face = shuffled(map.mesh.triangle_count(), random);
    TestMap result = map;
    for (int v = 0; v < map.mesh.vertex_count(); ++v) result.rays.row(vertex[v]) = map.rays.row(v);
    for (int f = 0; f < map.mesh.triangle_count(); ++f) {
        const int turn = random.below(3);
        for (int k = 0; k < 3; ++k) result.mesh.F(face[f], k) = vertex[map.mesh.F(f, (k + turn) % 3)];
    }
    result.mesh.V = result.rays;
    return result;
}

TestMap rescaled(const TestMap& map, Random& random) {
    // A directed edge without its twin is on the border.
    std::vector<std::pair<int, int>> edges;
    for (int f = 0; f < map.mesh.triangle_count(); ++f)
        for (int k = 0; k < 3; ++k) edges.emplace_back(map.mesh.F(f, k), map.mesh.F(f, (k + 1) % 3));
    std::sort(edges.begin(), edges.end());
    std::vector<bool> border(static_cast<std::size_t>(map.mesh.vertex_count()), false);
    for (const auto& [u, v] : edges)
        if (!std::binary_search(edges.begin(), edges.end(), std::pair(v, u))) border[u] = border[v] = true;
    TestMap result = map;
    for (int v = 0; v < map.mesh.vertex_count(); ++v)
        if (!border[v]) result.rays.row(v) *= std::ldexp(1.0, random.below(21) - 10);
    result.mesh.V = result.rays;
    return result;
}

MapBuilder polygon_builder(const std::vector<Ray>& border, Random& random) {
    for (int attempt = 0; attempt < 1000; ++attempt) {
        std::vector<int> left(border.size());
        std::iota(left.begin(), left.end(), 0);
        std::vector<Eigen::Vector3i> ears;
        while (left.size() >= 3) {
            const int n = static_cast<int>(left.size()), start = random.below(n);
            int cut = -1;
            for (int k = 0; k < n && cut < 0; ++k) {
                const int i = (start + k) % n;
                if (orientation(border[left[(i + n - 1) % n]], border[left[i]], border[left[(i + 1) % n]]) >
                    0)
                    cut = i;
            }
            if (cut < 0) break;
            ears.emplace_back(left[(cut + n - 1) % n], left[cut], left[(cut + 1) % n]);
            left.erase(left.begin() + cut);
        }
        if (left.size() > 2) continue;  // what was left lies on a line
        Triangles F(static_cast<Eigen::Index>(ears.size()), 3);
        for (std::size_t f = 0; f < ears.size(); ++f) F.row(static_cast<Eigen::Index>(f)) = ears[f];
        return MapBuilder(border, F);
    }
    throw std::logic_error("the polygon is not convex");
}

MapBuilder tetrahedron_builder(Random& random) {
    Triangles F(4, 3);
    F << 0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2;
    for (;;) {
        std::vector<Ray> rays(4);
        for (Ray& r : rays) r = random.direction();
        bool round_origin = true;
        for (int f = 0; f < 4; ++f)
            round_origin = round_origin && orientation(rays[F(f, 0)], rays[F(f, 1)], rays[F(f, 2)]) > 0;
        if (round_origin) return MapBuilder(rays, F);
    }
}

MapBuilder octahedron_builder() {
    Triangles F(8, 3);
    F << 0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5;
    return MapBuilder({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}, F);
}

std::vector<Ray> circle(int count, double phase) {
    std::vector<Ray> border;
    for (int k = 0; k < count; ++k) {
        const double angle = phase + 2 * std::numbers::pi * k / count;
        border.emplace_back(std::cos(angle), std::sin(angle), 1.0);
    }
    return border;
}

std::vector<Ray> lattice_square(int size, double unit) {
    std::vector<Ray> border;
    for (int k = 0; k < size; ++k) border.emplace_back(k * unit, 0.0, 1.0);
    for (int k = 0; k < size; ++k) border.emplace_back(size * unit, k * unit, 1.0);
    for (int k = size; k > 0; --k) border.emplace_back(k * unit, size * unit, 1.0);
    for (int k = size; k > 0; --k) border.emplace_back(0.0, k * unit, 1.0);
    return border;
}

TestMap random_map(MapBuilder builder, const std::vector<Ray>& inner, int flips, Random& random) {
    for (const Ray& p : inner) {
        builder.insert(p);
        builder.flip(3, random);
    }
    builder.flip(flips, random);
    return renumbered(builder.map(), random);
}

TestMap delaunay_map(MapBuilder builder, const std::vector<Ray>& inner) {
    builder.make_delaunay();
    int next = 2 * builder.vertex_count();
    for (const Ray& p : inner) {
        builder.insert(p);
        if (builder.vertex_count() < next) continue;
        builder.make_delaunay();
        next = 3 * builder.vertex_count() / 2;
    }
    builder.make_delaunay();
    return builder.map();
}

std::vector<Ray> random_disk_points(int count, Random& random) {
    std::vector<Ray> points;
    while (static_cast<int>(points.size()) < count) {
        const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
        const Ray p(x, y, 1.0);
        if (p.head<2>().norm() < 0.99) points.push_back(p);
    }
    return points;
}

std::vector<Ray> random_directions(int count, Random& random) {
    std::vector<Ray> points;
    for (int k = 0; k < count; ++k) points.push_back(random.direction());
    return points;
}

std::vector<Ray> random_lattice_points(int count, int size, double unit, Random& random) {
    std::vector<Ray> points;
    for (int k = 0; k < count; ++k) {
        const int x = 1 + random.below(size - 1), y = 1 + random.below(size - 1);
        points.emplace_back(x * unit, y * unit, 1.0);
    }
    return points;
}

std::vector<Ray> random_integer_directions(int count, int size, Random& random) {
    std::vector<Ray> points;
    while (static_cast<int>(points.size()) < count) {
        const auto coordinate = [&] { return static_cast<double>(random.below(2 * size + 1) - size); };
        const double x = coordinate(), y = coordinate(), z = coordinate();
        if (x != 0 || y != 0 || z != 0) points.emplace_back(x, y, z);
    }
    return points;
}

}  // namespace automorph::testing
