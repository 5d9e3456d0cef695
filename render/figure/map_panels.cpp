#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <utility>

#include "morph/mesh/geometry.h"
#include "render/figure/panels.h"

namespace automorph {
namespace {

using render::Canvas;

/// Directions of the picture in the world.
struct View {
    Eigen::Vector3d right, up, backward;

    explicit View(const render::Camera& camera) : backward((camera.position - camera.target).normalized()) {
        right = camera.up.cross(backward).normalized();
        up = backward.cross(right);
    }
};

/// The colour of a triangle by a lamp at the upper left of the camera, as the studio has it.
render::Color shade(const Shooting& shooting, const View& view, const Eigen::Vector3d& normal) {
    const Eigen::Vector3d to_lamp = (0.8 * view.backward + 0.7 * view.up - 0.55 * view.right).normalized();
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

/// The map turned such that it resembles the picture: by the best rotation of the plane between the map and
/// the shape as the camera sees it.
Points upright_disk(const ShapeMap& map, const View& view) {
    const Points V = map.mesh.V.rowwise() - map.mesh.V.colwise().mean();
    const Eigen::VectorXd x = V * view.right, y = V * view.up;
    const Eigen::VectorXd u = map.rays.col(0), v = map.rays.col(1);
    const double angle = std::atan2(u.dot(y) - v.dot(x), u.dot(x) + v.dot(y));
    Points places = Points::Zero(V.rows(), 3);
    places.col(0) = std::cos(angle) * u - std::sin(angle) * v;
    places.col(1) = std::sin(angle) * u + std::cos(angle) * v;
    return places;
}

/// The sphere turned such that places lie as on the shape [Kabsch76], in the picture's axes.
Points upright_sphere(const ShapeMap& map, const View& view) {
    const Points V = map.mesh.V.rowwise() - map.mesh.V.colwise().mean();
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(V.transpose() * map.rays,
                                                Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Vector3d signs(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant());
    const Eigen::Matrix3d to_shape = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
    Eigen::Matrix3d axes;
    axes << view.right, view.up, view.backward;
    return map.rays * to_shape.transpose() * axes;
}

FigureCell map_drawing(const Shooting& shooting, const ShapeMap& map) {
    const View view(shooting.camera);
    const Points places = map.loop.empty() ? upright_sphere(map, view) : upright_disk(map, view);
    const double radius = 0.5 * std::min(shooting.width, shooting.height) * (1.0 - shooting.picture.margin);
    const Eigen::Vector2d center(0.5 * shooting.width, 0.5 * shooting.height);
    const auto on_page = [&](int v) -> Eigen::Vector2d {
        return center + radius * Eigen::Vector2d(places(v, 0), -places(v, 1));
    };
    FigureCell cell;
    Canvas canvas(render::Image(shooting.width, shooting.height, 3, 1.0f));
    const Canvas::Pen pen{drawing::kInk, drawing::scaled(shooting, 1.0 / 700, 0.5), 0.75};
    for (int f = 0; f < map.mesh.triangle_count(); ++f) {
        const std::vector<Eigen::Vector2d> corners{on_page(map.mesh.F(f, 0)), on_page(map.mesh.F(f, 1)),
                                                   on_page(map.mesh.F(f, 2))};
        const Eigen::Vector2d a = corners[1] - corners[0], b = corners[2] - corners[0];
        if (a.x() * b.y() - a.y() * b.x() >= 0.0) continue;  // the far side of the sphere; y runs downwards
        const bool filling = f >= map.own_triangles;
        canvas.polygon(
            corners,
            filling ? drawing::kPaper
                    : shade(shooting, view, doubled_area_vector(map.mesh.V, map.mesh.F, f).normalized()),
            pen);
    }
    cell.image = canvas.image();
    return cell;
}

}  // namespace

std::vector<FigureCell> map_panels(const Shooting& shooting, const InputMesh& shape, const ShapeMap& map) {
    std::vector<FigureCell> cells;
    cells.push_back(picture_with_edges(shooting, shape.mesh));
    cells.back().label = "mesh";
    cells.push_back(map_drawing(shooting, map));
    cells.back().label = map.loop.empty() ? "map onto the sphere" : "harmonic map";
    return cells;
}

}  // namespace automorph
