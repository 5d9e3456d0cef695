#include "morph/shapes/head.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "morph/mesh/connectivity.h"
#include "morph/mesh/errors.h"
#include "morph/mesh/geometry.h"
#include "morph/shapes/crop.h"
#include "morph/shapes/head_sculpture.h"
#include "morph/shapes/marching.h"
#include "morph/shapes/remesh.h"

namespace automorph {

namespace {

using sculpt::kHeadHeight;
using sculpt::Vec;
using sculpt::Vec3;

constexpr double kCell = 0.25;  // cm; the slit between the lips and the space behind the ears are wider
constexpr Eigen::Vector3d::Scalar kBox[2][3] = {{-10.5, -18.5, -12.5}, {10.5, 13.0, 14.0}};
constexpr double kAway = 8.0, kCoarse = 1.8;  // cm behind a border; edges there, relative
constexpr double kNeckCut = -15.3;            // height of the cut, cm

/// A part with finer edges: relative to those around it, all of them within `inner`, none beyond `outer`, cm.
struct Feature {
    Vec3 centre;  // of the left one if there are two
    double inner, outer, spacing;
};
constexpr Feature kFeatures[] = {
    {{0, -3.0, 8.0}, 6.0, 12.0, 0.62},    // face
    {{3.1, 0.15, 8.0}, 1.7, 3.6, 0.30},   // eyes
    {{0, -7.0, 9.8}, 2.6, 4.8, 0.44},     // mouth
    {{0.7, -4.5, 10.3}, 1.2, 2.8, 0.62},  // base of the nose
    {{7.4, -1.5, -1.7}, 3.3, 5.2, 0.34},  // ears
};

double feature_spacing(const Eigen::Vector3d& p) {
    const Vec3 q{std::abs(p.x()) * kHeadHeight, p.y() * kHeadHeight, p.z() * kHeadHeight};
    double product = 1.0;
    for (const Feature& each : kFeatures) {
        const Vec3 d = q - each.centre;
        const double away = sculpt::ramp(std::sqrt(sculpt::dot(d, d)), each.inner, each.outer);
        product *= each.spacing + (1.0 - each.spacing) * away;
    }
    return product;
}

template <class S>
S side_of(HeadCrop crop, const Vec<S>& p) {
    if (crop == HeadCrop::Head) return S(kNeckCut) - p.y;
    // A trough in front of the ears that rises to the hair and passes under the chin before the neck.
    const S up = p.y + 2.0;
    return 2.2 + 0.034 * (up * up) - p.z;
}

/// A field of the sculpture, in head heights.
template <class Field>
ImplicitSurface in_head_heights(const Field& field) {
    return [field](const Eigen::Vector3d& p) -> FieldSample {
        const Jet f = field(Vec<Jet>{Jet(kHeadHeight * p.x(), 1, 0, 0), Jet(kHeadHeight * p.y(), 0, 1, 0),
                                     Jet(kHeadHeight * p.z(), 0, 0, 1)});
        return {f.value / kHeadHeight, Eigen::Vector3d(f.x, f.y, f.z)};
    };
}

/// Edge lengths relative to those of the cranium; longer behind the border, where `side` is positive.
class Spacing {
public:
    explicit Spacing(HeadCrop crop) : crop_(crop) {}
    double operator()(const Eigen::Vector3d& p) const {
        if (crop_ == HeadCrop::Closed) return feature_spacing(p);
        const double beyond =
            side_of(crop_, Vec3{kHeadHeight * p.x(), kHeadHeight * p.y(), kHeadHeight * p.z()});
        const double away = sculpt::ramp(beyond, 0.5, kAway);
        return feature_spacing(p) * (1.0 - away) + kCoarse * away;
    }

private:
    HeadCrop crop_;
};

/// The sum over triangles of area over spacing squared: what a remeshed part's triangles are in proportion
/// to.
double triangle_demand(const Mesh& mesh, const Spacing& spacing) {
    const Eigen::VectorXd areas = triangle_areas(mesh);
    double sum = 0.0;
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        const Eigen::Vector3d centre =
            (mesh.V.row(mesh.F(f, 0)) + mesh.V.row(mesh.F(f, 1)) + mesh.V.row(mesh.F(f, 2))).transpose() /
            3.0;
        const double size = spacing(centre);
        sum += areas[f] / (size * size);
    }
    return sum;
}

}  // namespace

ImplicitSurface head_surface() {
    return in_head_heights([](const Vec<Jet>& p) { return sculpt::head_sculpture(p); });
}

Mesh head(const HeadOptions& options) {
    const ImplicitSurface surface = head_surface();
    const ImplicitSurface side =
        in_head_heights([crop = options.crop](const Vec<Jet>& p) { return side_of(crop, p); });

    MarchingOptions marching;
    marching.low = Eigen::Vector3d(kBox[0][0], kBox[0][1], kBox[0][2]) / kHeadHeight;
    marching.high = Eigen::Vector3d(kBox[1][0], kBox[1][1], kBox[1][2]) / kHeadHeight;
    marching.cell = kCell / kHeadHeight;
    const Mesh start = marching_tetrahedra(
        [](const Eigen::Vector3d& p) {
            return sculpt::head_sculpture(
                Vec3{kHeadHeight * p.x(), kHeadHeight * p.y(), kHeadHeight * p.z()});
        },
        marching);

    RemeshOptions remeshing;
    remeshing.triangles = options.shape.triangles;
    remeshing.seed = options.shape.seed;
    const Spacing spacing(options.crop);
    remeshing.spacing = spacing;
    if (options.crop != HeadCrop::Closed) {
        const double share =
            triangle_demand(crop(start, surface, side), spacing) / triangle_demand(start, spacing);
        remeshing.triangles = static_cast<int>(std::lround(options.shape.triangles / share));
    }
    Mesh mesh = remesh(start, surface, remeshing);
    const int euler = euler_characteristic(connectivity(mesh.F, mesh.vertex_count()));
    if (euler != 2) throw SolverFailure(fmt::format("head: Euler characteristic {}, expected 2", euler));
    if (options.crop != HeadCrop::Closed) mesh = crop(mesh, surface, side);

    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const Eigen::Vector3d p = deform_head(options.parameters, mesh.V.row(v).transpose());
        mesh.V.row(v) =
            (options.shape.scale * (options.shape.rotation * p) + options.shape.translation).transpose();
    }
    return mesh;
}

}  // namespace automorph
