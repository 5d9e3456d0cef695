#include "tests/render/compare/power_scenes.h"

#include <cmath>

#include "morph/mesh/geometry.h"
#include "render/camera/framing.h"
#include "render/integrator/render.h"
#include "render/studio/studio.h"
#include "tests/render/shapes.h"

namespace power {

using namespace automorph;
using namespace automorph::render;

namespace {

struct Parts {
    Shape shape;
    Points normals;    // #V x 3
    int vertex = 0;    // the one that changes are about: in the middle of the visible side
    int triangle = 0;  // one at that vertex
};

Parts make_parts() {
    Parts parts;
    parts.shape = icosphere(3);
    Points& V = parts.shape.V;
    for (Eigen::Index i = 0; i < V.rows(); ++i) {
        const Eigen::Vector3d p = V.row(i);
        V.row(i) *= 1.0 + 0.15 * std::sin(4.0 * p.x()) * std::sin(3.0 * p.y() + 1.0) * std::sin(5.0 * p.z());
    }
    const Triangles& F = parts.shape.F;
    parts.normals = area_weighted_normals(V, F);
    const Eigen::RowVector3d seen(-0.25, -0.9, 0.35);
    (V.rowwise() - seen).rowwise().squaredNorm().minCoeff(&parts.vertex);
    while ((F.row(parts.triangle).array() != parts.vertex).all()) ++parts.triangle;
    return parts;
}

Material material_of(Body body) {
    Material material = clay();
    if (body == Body::Metal) {
        material.base_color = {0.9f, 0.6f, 0.4f};
        material.metallic = 1.0f;
        material.roughness = 0.4f;
    } else if (body == Body::Glass) {
        material.base_color.setConstant(0.95f);
        material.transmission = 1.0f;
        material.roughness = 0.1f;
    }
    return material;
}

void add_body(Scene& scene, Parts parts, Body body, Change change) {
    MeshOptions options;
    options.material = material_of(body);
    if (change == Change::Albedo) options.material.base_color *= 1.01f;
    if (change == Change::Normal) parts.normals.row(parts.vertex) *= -1.0;
    options.vertex_normals = parts.normals;
    Triangles F = parts.shape.F;
    if (change == Change::Ring) F = without_ring(F, parts.vertex);
    if (change == Change::DarkTriangle) {
        MeshOptions darker = options;
        darker.material.base_color *= 0.5f;
        scene.add_mesh(parts.shape.V, F.row(parts.triangle), darker);
        F.row(parts.triangle).setConstant(F(parts.triangle, 0));  // leaves its place to the darker one
    }
    scene.add_mesh(parts.shape.V, F, options);
}

void add_coloured_ground(Scene& scene) {
    const Shape ground = square(8.0, -1.1);
    MeshOptions options;
    options.normals = Normals::Flat;
    options.vertex_colors = Points(4, 3);
    options.vertex_colors << 0.8, 0.3, 0.2, 0.2, 0.7, 0.3, 0.2, 0.3, 0.8, 0.8, 0.8, 0.3;
    scene.add_mesh(ground.V, ground.F, options);
    scene.lights.push_back(square_light({2, -2, 4}, {0, 0, 0}, 0.6f, Color::Constant(60.0f)));
    scene.sky.radiance.setConstant(0.3f);
}

}  // namespace

const char* name(Body body) {
    return body == Body::Clay ? "clay" : body == Body::Metal ? "metal" : "glass";
}

NoisyImage picture(Body body, Change change, const Settings& settings) {
    const Parts parts = make_parts();
    Scene scene({.embree_config = "isa=sse4.2"});
    add_body(scene, parts, body, change);
    Camera camera = frame_all({parts.shape.V}, {.direction = {0.2, 1.0, -0.35}, .margin = 0.2});
    if (body == Body::Glass) {
        add_coloured_ground(scene);
    } else {
        Bounds bounds;
        bounds.add(parts.shape.V);
        add_studio(scene, camera, bounds);
    }
    if (change == Change::Light) {
        for (RectangleLight& light : scene.lights) light.radiance *= 1.02f;
    }
    if (change == Change::Camera) camera = turned(camera, 0.1);

    RenderOptions options;
    options.width = options.height = settings.size;
    options.spp = settings.spp;
    options.seed = settings.seed;
    options.filter = settings.filter;
    options.adaptive_error = settings.adaptive_error;
    options.pilot = 8;
    options.layers = true;
    const RenderResult result = automorph::render::render(scene, camera, options);
    return {result.image, result.layers.value().variance, result.layers.value().samples};
}

}  // namespace power
