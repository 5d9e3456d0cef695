#include "render/figure/markers.h"

#include <utility>

#include "render/figure/panels.h"

namespace automorph {
namespace {

int nearest(const Points& V, const Eigen::RowVector3d& point) {
    Eigen::Index row = 0;
    (V.rowwise() - point).rowwise().squaredNorm().minCoeff(&row);
    return static_cast<int>(row);
}

}  // namespace

std::vector<int> farthest_vertices(const Points& V, int count) {
    std::vector<int> chosen;
    Eigen::VectorXd distance = (V.rowwise() - V.colwise().mean()).rowwise().squaredNorm();
    while (static_cast<int>(chosen.size()) < count) {
        Eigen::Index row = 0;
        if (!(distance.maxCoeff(&row) > 0)) break;
        const Eigen::VectorXd from_new = (V.rowwise() - V.row(row)).rowwise().squaredNorm();
        distance = chosen.empty() ? from_new : distance.cwiseMin(from_new).eval();
        chosen.push_back(static_cast<int>(row));
    }
    return chosen;
}

std::vector<int> marked_vertices(const MarkersConfig& config, const Points& source, const Points& ends,
                                 const std::vector<FeatureReport>& features) {
    std::vector<int> of_source;
    if (config.kind == MarkersConfig::Kind::Spread) of_source = farthest_vertices(source, config.count);
    if (config.kind == MarkersConfig::Kind::Features) {
        for (const FeatureReport& found : features) {
            for (const FeatureReport::Match& match : found.matches) of_source.push_back(match.source);
        }
    }
    // Merged meshes number their vertices anew, but keep the source's places.
    std::vector<int> merged;
    for (const int v : of_source) merged.push_back(nearest(ends, source.row(v)));
    return merged;
}

Markers::Markers(render::Scene& scene, std::vector<int> vertices, double radius, int time_steps)
    : vertices_(std::move(vertices)), radius_(radius), sphere_(render::make_sphere()) {
    if (vertices_.empty()) return;
    const auto count = static_cast<int>(vertices_.size());
    const Eigen::Index n = sphere_.directions.rows();
    render::MeshOptions options;
    options.time_steps = time_steps;
    options.vertex_normals = sphere_.directions.replicate(count, 1);
    options.vertex_colors.resize(n * count, 3);
    for (int i = 0; i < count; ++i) {
        const render::Color color = drawing::distinct_color(static_cast<std::size_t>(i));
        options.vertex_colors.middleRows(n * i, n).rowwise() =
            color.matrix().cast<double>().transpose().eval();
    }
    const Points at_origin = Points::Zero(count, 3);
    mesh_ = scene.add_mesh(render::sphere_vertices(sphere_, at_origin, radius_),
                           render::sphere_triangles(sphere_, count), options);
}

void Markers::move(render::Scene& scene, const std::vector<Points>& steps) {
    if (mesh_ < 0) return;
    std::vector<Points> moved;
    for (const Points& V : steps) {
        Points centers(static_cast<Eigen::Index>(vertices_.size()), 3);
        for (std::size_t i = 0; i < vertices_.size(); ++i)
            centers.row(static_cast<Eigen::Index>(i)) = V.row(vertices_[i]);
        moved.push_back(render::sphere_vertices(sphere_, centers, radius_));
    }
    scene.move_mesh(mesh_, moved);
}

}  // namespace automorph
