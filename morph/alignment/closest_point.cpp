#include "morph/alignment/closest_point.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "morph/mesh/errors.h"
#include "morph/mesh/geometry.h"
#include "morph/mesh/search_tree.h"

namespace automorph {

namespace {

// The tree has float coordinates about the mesh's centre in units of its size: this much more than the best
// distance so far is looked through, so that their rounding hides nothing.
constexpr double kWider = 1.0 + 1e-6, kFarther = 1e-6;

/// Barycentric coordinates of the point of triangle abc closest to p [Ericson05, Sec. 5.1.5].
Eigen::Vector3d closest(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                        const Eigen::Vector3d& c) {
    const Eigen::Vector3d ab = b - a, ac = c - a, ap = p - a;
    const double d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0.0 && d2 <= 0.0) return {1.0, 0.0, 0.0};
    const Eigen::Vector3d bp = p - b;
    const double d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= 0.0 && d4 <= d3) return {0.0, 1.0, 0.0};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
        const double v = d1 / (d1 - d3);
        return {1.0 - v, v, 0.0};
    }
    const Eigen::Vector3d cp = p - c;
    const double d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= 0.0 && d5 <= d6) return {0.0, 0.0, 1.0};
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
        const double w = d2 / (d2 - d6);
        return {1.0 - w, 0.0, w};
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return {0.0, 1.0 - w, w};
    }
    const double sum = va + vb + vc;
    return {va / sum, vb / sum, vc / sum};
}

struct Search {
    const Mesh* mesh = nullptr;
    const Points* normals = nullptr;
    Eigen::Vector3d point, normal;
    double least_agreement = 0.0;
    double squared_distance = std::numeric_limits<double>::infinity();
    int triangle = -1;
    Eigen::Vector3d weights;
};

bool visit(RTCPointQueryFunctionArguments* arguments) {
    Search& search = *static_cast<Search*>(arguments->userPtr);
    const int f = static_cast<int>(arguments->primID);
    if (!(search.normal.dot(search.normals->row(f)) > search.least_agreement)) return false;
    const Eigen::Vector3d a = search.mesh->V.row(search.mesh->F(f, 0)),
                          b = search.mesh->V.row(search.mesh->F(f, 1)),
                          c = search.mesh->V.row(search.mesh->F(f, 2));
    const Eigen::Vector3d weights = closest(search.point, a, b, c);
    if (!weights.allFinite()) return false;
    const double distance2 = (weights[0] * a + weights[1] * b + weights[2] * c - search.point).squaredNorm();
    if (distance2 > search.squared_distance) return false;
    if (distance2 == search.squared_distance && f > search.triangle) return false;
    search.squared_distance = distance2;
    search.triangle = f;
    search.weights = weights;
    const auto radius = static_cast<float>(std::sqrt(distance2) * kWider + kFarther);
    if (radius >= arguments->query->radius) return false;
    arguments->query->radius = radius;
    return true;
}

}  // namespace

struct ClosestPoints::Tree {
    UnitFrame frame;
    Mesh mesh;  // in that frame
    Points normals;
    SearchDevice device{"alignment"};
    SearchTree tree;

    explicit Tree(const Mesh& of) : frame(of.V), mesh{frame.in(of.V), of.F} {
        normals.resize(mesh.F.rows(), 3);
        for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
            normals.row(f) = doubled_area_vector(mesh.V, mesh.F, f).stableNormalized();
        build();
    }

    void build() {
        const RTCGeometry geometry = device.geometry(RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<float*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                    static_cast<std::size_t>(mesh.V.rows())));
        auto* triangles = static_cast<unsigned*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    3 * sizeof(unsigned), static_cast<std::size_t>(mesh.F.rows())));
        if (vertices && triangles) {  // else the tree says so
            std::transform(mesh.V.data(), mesh.V.data() + mesh.V.size(), vertices,
                           [](double x) { return static_cast<float>(x); });
            std::transform(mesh.F.data(), mesh.F.data() + mesh.F.size(), triangles,
                           [](int v) { return static_cast<unsigned>(v); });
        }
        tree = device.tree(geometry, RTC_SCENE_FLAG_ROBUST);
    }
};

ClosestPoints::ClosestPoints(const Mesh& mesh) : tree_(std::make_unique<Tree>(mesh)) {}
ClosestPoints::~ClosestPoints() = default;

SurfacePlace ClosestPoints::query(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                                  double least_agreement) const {
    Search search;
    search.mesh = &tree_->mesh;
    search.normals = &tree_->normals;
    search.point = (point - tree_->frame.centre.transpose()) / tree_->frame.size;
    search.normal = normal;
    search.least_agreement = least_agreement;
    RTCPointQuery query;
    query.x = static_cast<float>(search.point.x());
    query.y = static_cast<float>(search.point.y());
    query.z = static_cast<float>(search.point.z());
    query.time = 0.0f;
    query.radius = std::numeric_limits<float>::infinity();
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(tree_->tree.get(), &query, &context, visit, &search);
    if (search.triangle < 0) return {};
    const auto corners = tree_->mesh.F.row(search.triangle);
    return {{corners[0], corners[1], corners[2]}, search.weights};
}

}  // namespace automorph
