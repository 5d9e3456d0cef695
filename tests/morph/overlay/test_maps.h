#pragma once

#include <OpenMesh/Core/Mesh/TriConnectivity.hh>
#include <cstdint>
#include <random>
#include <vector>

#include "morph/exact/predicates.h"
#include "morph/mesh/mesh.h"

namespace automorph::testing {

/// Random numbers that are the same on every standard library.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    /// Uniform in [0, count).
    int below(int count);
    /// Uniform in [low, high).
    double uniform(double low, double high);
    /// Uniform on the unit sphere.
    Ray direction();

private:
    std::mt19937_64 engine_;
};

/// A one-to-one map: a mesh (V holds the rays too) and the ray of each vertex.
struct TestMap {
    Mesh mesh;
    Points rays;
};

struct MapPair {
    TestMap a, b;
};

/// Grows a triangulated map by inserting vertices and flipping edges; every step is guarded by the exact
/// orientation, so that the map stays one-to-one, in the plane (z > 0, with border) and on the sphere.
class MapBuilder {
public:
    MapBuilder(const std::vector<Ray>& rays, const Triangles& F);

    /// Splits the triangle or edge that holds p. False where p is a vertex already, on the border or outside.
    bool insert(const Ray& p);
    /// Tries `attempts` random edge flips; returns how many were possible.
    int flip(int attempts, Random& random);
    /// Lawson's flips towards the Delaunay triangulation (in-circle test in doubles; ties stay).
    void make_delaunay();
    int vertex_count() const { return static_cast<int>(rays_.size()); }
    TestMap map() const;

private:
    bool flip_if_convex(OpenMesh::EdgeHandle edge);
    OpenMesh::FaceHandle locate(const Ray& p);
    bool delaunay(OpenMesh::HalfedgeHandle h) const;
    const Ray& ray(OpenMesh::VertexHandle v) const { return rays_[static_cast<std::size_t>(v.idx())]; }

    OpenMesh::TriConnectivity topology_;
    std::vector<Ray> rays_;
    bool planar_ = false;
    OpenMesh::FaceHandle last_{0};
    Random turns_{1};
};

/// The same map with vertices, triangles and first corners in another order.
TestMap renumbered(const TestMap& map, Random& random);

/// The same map with every inner ray scaled by a random power of two, which moves nothing; border rays stay.
TestMap rescaled(const TestMap& map, Random& random);

/// A triangulation of a convex polygon without inner vertices; collinear border vertices are allowed.
MapBuilder polygon_builder(const std::vector<Ray>& border, Random& random);
/// A random tetrahedron round the origin.
MapBuilder tetrahedron_builder(Random& random);
/// The rays (+-1, 0, 0), (0, +-1, 0), (0, 0, +-1).
MapBuilder octahedron_builder();

std::vector<Ray> circle(int count, double phase = 0.0);
/// All border points of the lattice [0, size]^2, counter-clockwise, times `unit`.
std::vector<Ray> lattice_square(int size, double unit = 1.0);

/// Vertices with the given rays, in a triangulation grown in random order with random flips.
TestMap random_map(MapBuilder builder, const std::vector<Ray>& inner, int flips, Random& random);
/// The same, Delaunay: a map of good triangles, for large sizes.
TestMap delaunay_map(MapBuilder builder, const std::vector<Ray>& inner);

/// Points in the disk of radius 0.99.
std::vector<Ray> random_disk_points(int count, Random& random);
std::vector<Ray> random_directions(int count, Random& random);
/// Inner lattice points of [0, size]^2, times `unit`, with repetition.
std::vector<Ray> random_lattice_points(int count, int size, double unit, Random& random);
/// Integer directions in [-size, size]^3 without the origin: many are parallel, many lie on common great
/// circles.
std::vector<Ray> random_integer_directions(int count, int size, Random& random);

}  // namespace automorph::testing
