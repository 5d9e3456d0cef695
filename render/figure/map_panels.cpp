#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "morph/mesh/geometry.h"
#include "render/figure/panels.h"

namespace automorph {
namespace {

using render::Canvas;

/// Directions of the world as the camera sees them: rows are right, up, and towards the camera.
Eigen::Matrix3d page_axes(const render::Camera& camera) {
    const Eigen::Vector3d backward = (camera.position - camera.target).normalized();
    const Eigen::Vector3d right = camera.up.cross(backward).normalized();
    Eigen::Matrix3d axes;
    axes << right.transpose(), backward.cross(right).transpose(), backward.transpose();
    return axes;
}

/// The same seen from behind.
Eigen::Matrix3d half_turn() {
    return Eigen::Vector3d(-1, 1, -1).asDiagonal();
}

/// The colour of a triangle by a lamp at the upper left of the camera, as the studio has it.
/// @param normal  in the axes of the page
render::Color shade(const Shooting& shooting, const Eigen::Vector3d& normal) {
    const Eigen::Vector3d to_lamp = Eigen::Vector3d(-0.55, 0.7, 0.8).normalized();
    const double light = 0.22 + 0.9 * std::max(0.0, normal.dot(to_lamp));
    return (std::min(light, 1.2) * shooting.picture.albedo).cast<float>().array();
}

/// Each edge once.
std::vector<std::pair<int, int>> edges_of(const Triangles& F) {
    std::vector<std::pair<int, int>> edges;
    for (Eigen::Index f = 0; f < F.rows(); ++f) {
        for (int k = 0; k < 3; ++k) edges.push_back(std::minmax(+F(f, k), +F(f, (k + 1) % 3)));
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

FigureCell picture_with_edges(const Shooting& shooting, const Mesh& mesh) {
    Subject subject(shooting, mesh.V, mesh.F);
    FigureCell cell = subject.shoot(mesh.V, {});
    const render::PictureCamera camera(shooting.camera, shooting.width, shooting.height);
    const Points normals = vertex_normals(mesh);
    Canvas canvas(cell.image);
    const Canvas::Pen pen{drawing::kInk, drawing::scaled(shooting, 1.0 / 700, 0.5), 0.75};
    const auto draw_if_seen = [&](int i, int j) {
        const Eigen::Vector3d p = mesh.V.row(i), q = mesh.V.row(j), m = normals.row(i), n = normals.row(j);
        const bool seen =
            subject.sees(p, m) && subject.sees(q, n) && subject.sees(0.5 * (p + q), (m + n).normalized());
        const auto from = camera.project(p), to = camera.project(q);
        if (seen && from && to) canvas.line(*from, *to, pen);
    };
    for (const auto& [i, j] : edges_of(mesh.F)) draw_if_seen(i, j);
    cell.image = canvas.image();
    cell.layers.reset();
    return cell;
}

/// The turn of the disk about its centre that makes it resemble the shape: the best rotation of the plane
/// between the map and the shape as it is seen. @param seen  #V x 3, the shape in the axes of the page
Eigen::Matrix3d upright_disk(const Points& rays, const Points& seen) {
    const Eigen::VectorXd x = seen.col(0), y = seen.col(1), u = rays.col(0), v = rays.col(1);
    const double angle = std::atan2(u.dot(y) - v.dot(x), u.dot(x) + v.dot(y));
    return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

/// The turn of the sphere that makes places lie as on the shape [Kabsch76].
Eigen::Matrix3d upright_sphere(const Points& rays, const Points& seen) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(seen.transpose() * rays,
                                                Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Vector3d signs(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant());
    return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

/// An open surface that shows the camera its back is looked at from behind.
Eigen::Matrix3d facing_axes(const DomainMap& map, const Eigen::Matrix3d& axes) {
    Eigen::Vector3d area = Eigen::Vector3d::Zero();
    for (Eigen::Index f = 0; f < map.mesh.F.rows(); ++f)
        area += doubled_area_vector(map.mesh.V, map.mesh.F, f);
    return map.on_disk() && axes.row(2).dot(area) < 0.0 ? half_turn() * axes : axes;
}

/// Width of edges: a share of the mean edge at most, so that dense meshes do not turn black.
double edge_width(const Shooting& shooting, const DomainMap& map, double radius) {
    constexpr double kMostOfEdge = 0.15;
    const double sides = map.on_disk() ? 1.0 : 4.0;  // surface of the unit sphere over that of the disk
    const double triangle = sides * std::numbers::pi * radius * radius / map.mesh.triangle_count();
    const double edge = std::sqrt(4.0 / std::sqrt(3.0) * triangle);  // of equilateral ones
    return std::min(drawing::scaled(shooting, 1.0 / 700, 0.5), kMostOfEdge * edge);
}

/// The border of an open shape on the sphere, where it faces the reader.
/// @param places  #V x 3, on the page's axes; @param on_page  vertex -> pixels
template <class OnPage>
void draw_border(Canvas& canvas, const std::vector<int>& loop, const Points& places, const OnPage& on_page,
                 double width) {
    const Canvas::Pen pen{drawing::kInk, width};
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const int from = loop[i], to = loop[(i + 1) % loop.size()];
        if (places(from, 2) + places(to, 2) > 0.0) canvas.line(on_page(from), on_page(to), pen);
    }
}

}  // namespace

MapPose MapPose::from_behind() const {
    return {half_turn() * rays, half_turn() * shape};
}

MapPose upright_pose(const DomainMap& map, const render::Camera& camera) {
    MapPose pose;
    pose.shape = facing_axes(map, page_axes(camera));
    const Points seen = (map.mesh.V.rowwise() - map.mesh.V.colwise().mean()) * pose.shape.transpose();
    pose.rays = map.on_disk() ? upright_disk(map.rays, seen) : upright_sphere(map.rays, seen);
    return pose;
}

MapPose pose_beside(const MapPose& other, const DomainMap& map, const Eigen::Matrix3d& R) {
    return {other.rays, facing_axes(map, other.shape * R)};
}

FigureCell map_drawing(const Shooting& shooting, const DomainMap& map, const MapPose& pose) {
    const Points places = map.rays * pose.rays.transpose();
    const double radius = 0.5 * std::min(shooting.width, shooting.height) * (1.0 - shooting.picture.margin);
    const Eigen::Vector2d center(0.5 * shooting.width, 0.5 * shooting.height);
    const auto on_page = [&](int v) -> Eigen::Vector2d {
        return center + radius * Eigen::Vector2d(places(v, 0), -places(v, 1));
    };
    FigureCell cell;
    Canvas canvas(render::Image(shooting.width, shooting.height, 3, 1.0f));
    // What an open shape leaves free of the sphere is seen as such: between the outline and the border.
    const bool open_on_sphere = !map.loop.empty() && !map.on_disk();
    const double outline = drawing::scaled(shooting, 1.0 / 250, 1.0);
    if (open_on_sphere) canvas.dot(center, radius, drawing::kPaper, {drawing::kFaint, 0.5 * outline});
    const Canvas::Pen pen{drawing::kInk, edge_width(shooting, map, radius), 0.75};
    for (int f = 0; f < map.mesh.triangle_count(); ++f) {
        const std::vector<Eigen::Vector2d> corners{on_page(map.mesh.F(f, 0)), on_page(map.mesh.F(f, 1)),
                                                   on_page(map.mesh.F(f, 2))};
        const Eigen::Vector2d a = corners[1] - corners[0], b = corners[2] - corners[0];
        if (a.x() * b.y() - a.y() * b.x() >= 0.0) continue;  // the far side of the sphere; y runs downwards
        const Eigen::Vector3d normal = doubled_area_vector(map.mesh.V, map.mesh.F, f).normalized();
        const bool filling = map.is_filling[static_cast<std::size_t>(f)] != 0;
        canvas.polygon(corners, filling ? drawing::kPaper : shade(shooting, pose.shape * normal), pen);
    }
    if (open_on_sphere) draw_border(canvas, map.loop, places, on_page, outline);
    cell.image = canvas.image();
    return cell;
}

std::vector<FigureCell> map_panels(const Shooting& shooting, const InputMesh& shape, const ShapeMap& map) {
    std::vector<FigureCell> cells;
    cells.push_back(picture_with_edges(shooting, shape.mesh));
    cells.back().label = "mesh";
    cells.push_back(map_drawing(shooting, map, upright_pose(map, shooting.camera)));
    cells.back().label = map.on_disk() ? "harmonic map" : "map onto the sphere";
    return cells;
}

}  // namespace automorph
