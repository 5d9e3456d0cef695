#include "render/figure/mesh_source.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "morph/mesh/geometry.h"
#include "morph/shapes/head.h"
#include "morph/shapes/shapes.h"

namespace automorph {
namespace {

/// Centre of mass to the origin, root mean square distance of the surface from it to 1.
void fit(Mesh& mesh) {
    mesh.V.rowwise() -= centre_of_mass(mesh).transpose();
    const Eigen::VectorXd areas = vertex_areas(mesh);
    mesh.V /= std::sqrt(areas.dot(mesh.V.rowwise().squaredNorm()) / areas.sum());
}

}  // namespace

Eigen::Matrix3d rotation_matrix(const MeshConfig::Turn& turn) {
    const double radians = turn.degrees * std::numbers::pi / 180.0;
    return Eigen::AngleAxisd(radians, turn.axis.normalized()).toRotationMatrix();
}

InputMesh make_mesh(const MeshConfig& config, const std::string& name) {
    ShapeOptions options;
    options.triangles = config.triangles;
    options.seed = config.seed;
    options.rotation = rotation_matrix(config.rotation);
    options.translation = config.translation;
    options.scale = config.scale;
    switch (config.shape) {
        case MeshConfig::Shape::Ellipsoid:
            return admit_mesh(ellipsoid(config.semi_axes, options, config.opening), name);
        case MeshConfig::Shape::Star:
            return admit_mesh(star(config.star, options), name);
        case MeshConfig::Shape::Head:
            return admit_mesh(head({config.proportions, config.crop, options}), name);
        case MeshConfig::Shape::None:
            break;
    }
    InputMesh input = load_mesh(config.file.string());
    if (config.fit) fit(input.mesh);
    const Eigen::Matrix3d linear = options.scale * options.rotation;
    input.mesh.V = ((input.mesh.V * linear.transpose()).rowwise() + options.translation.transpose()).eval();
    return input;
}

}  // namespace automorph
