#include "tests/bench/golden_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "morph/mesh/errors.h"
#include "morph/mesh/geometry.h"
#include "render/figure/lighting.h"
#include "render/figure/looks.h"
#include "render/figure/mesh_source.h"
#include "render/integrator/render.h"
#include "tests/render/figure/golden.h"

namespace automorph::bench {
namespace {

using power::Change;

render::RenderResult shoot(const GoldenScene& golden, Change change, int spp, std::uint64_t seed) {
    PictureConfig picture = golden.picture;
    if (change == Change::Light) picture.light.strength *= 1.02;
    if (change == Change::Albedo) picture.albedo *= 1.01;
    render::MeshOptions surface;
    surface.normals = picture.normals;
    surface.material = material_of(picture, golden.width);
    surface.vertex_normals = golden.normals;
    if (change == Change::Normal) surface.vertex_normals.row(golden.vertex) *= -1.0;
    Triangles F = golden.mesh.F;
    if (change == Change::Ring) F = power::without_ring(F, golden.vertex);
    render::Scene scene({.embree_config = golden.embree_config});
    scene.add_mesh(golden.mesh.V, F, surface);
    add_light(scene, picture, golden.camera, golden.bounds, load_sky(picture, golden.camera));

    render::RenderOptions options;
    options.width = golden.width;
    options.height = golden.height;
    options.spp = spp;
    options.seed = seed;
    options.layers = true;
    const bool turn = change == Change::Camera;
    return render::render(scene, turn ? power::turned(golden.camera, 0.1) : golden.camera, options);
}

/// What the rings of all vertices look like, as if nothing hid them.
struct Rings {
    Eigen::VectorXd area;  // #V, pixels
    Eigen::VectorXd
        curve;  // #V, pixels times the angle (radians) between the normals of a triangle's corners
};

Rings rings_of(const GoldenScene& golden) {
    const render::PictureCamera camera(golden.camera, golden.width, golden.height);
    const Triangles& F = golden.mesh.F;
    const Points normals = golden.normals.rowwise().normalized();
    Rings rings{Eigen::VectorXd::Zero(normals.rows()), Eigen::VectorXd::Zero(normals.rows())};
    for (Eigen::Index f = 0; f < F.rows(); ++f) {
        const auto corner = [&](int k) { return camera.project(golden.mesh.V.row(F(f, k))); };
        const auto a = corner(0), b = corner(1), c = corner(2);
        if (!a || !b || !c) continue;
        const Eigen::Vector2d u = *b - *a, v = *c - *a;
        const double area = 0.5 * std::abs(u.x() * v.y() - u.y() * v.x());
        for (int k = 0; k < 3; ++k) {
            const auto normal = normals.row(F(f, k));
            const double angle = std::max((normal - normals.row(F(f, (k + 1) % 3))).norm(),
                                          (normal - normals.row(F(f, (k + 2) % 3))).norm());
            rings.area[F(f, k)] += area;
            rings.curve[F(f, k)] += area * angle;
        }
    }
    return rings;
}

/// Of the vertices that are seen in the middle third of the picture, the one whose ring is largest and most
/// curved: where a surface is flat, a normal turned round is the same to a two-sided material.
void find_vertex(GoldenScene& golden, const render::Layers& layers) {
    const Rings rings = rings_of(golden);
    for (int y = golden.height / 3; y < golden.height - golden.height / 3; ++y) {
        for (int x = golden.width / 3; x < golden.width - golden.width / 3; ++x) {
            if (*layers.object.at(x, y) != 0.0f) continue;
            const auto face = static_cast<Eigen::Index>(*layers.face.at(x, y));
            for (const int vertex : golden.mesh.F.row(face)) {
                if (golden.vertex < 0 || rings.curve[vertex] > rings.curve[golden.vertex])
                    golden.vertex = vertex;
            }
        }
    }
    if (golden.vertex < 0) throw Error(golden.name + ": no triangle is seen in the middle of the picture");
    golden.ring_area = rings.area[golden.vertex];
}

/// Everything but the surface of the cell, from the figure's render and what its camera frames.
GoldenScene scene_of(const PictureConfig& picture, const FigureOptions& options, const Figure& figure,
                     const std::vector<const Points*>& frames) {
    const Shooting shooting =
        shooting_of(picture, options, {figure.width, figure.height, figure.spp}, frames);
    GoldenScene golden;
    golden.picture = picture;
    golden.camera = shooting.camera;
    golden.bounds = shooting.bounds;
    golden.width = figure.width;
    golden.height = figure.height;
    golden.spp = figure.spp;
    golden.embree_config = options.embree_config;
    return golden;
}

/// Names the scene and holds it against the cell of the figure, where that is the picture as rendered.
void settle(GoldenScene& golden, const std::string& figure, std::size_t row, const FigureCell& cell) {
    golden.name = figure + ' ' + cell_name(row, cell.column);
    const render::RenderResult own = shoot(golden, Change::None, golden.spp, golden.picture.seed);
    if (cell.layers && own.image.pixels != cell.image.pixels)
        throw Error(golden.name + ": rendered for the benchmark, the cell differs from the figure's");
    find_vertex(golden, *own.layers);
}

FigureOptions cell_options() {
    FigureOptions options = golden::options();
    options.layers = true;
    options.panels = false;
    return options;
}

GoldenScene morph_scene(const std::string& name, const FigureConfig& config) {
    FigureOptions options = cell_options();
    const std::size_t row = config.rows.size() - 1, column = config.alphas.size() / 2;
    options.rows = Selection(fmt::format("{}", row + 1));
    options.cells = Selection(fmt::format("{}", column + 1));
    const Figure figure = render_figure(config, options);
    std::vector<Points> frames;
    for (const Motion& motion : figure.motions) {
        for (const double alpha : config.alphas) frames.push_back(motion.at(alpha));
    }
    std::vector<const Points*> framed;
    for (const Points& V : frames) framed.push_back(&V);
    GoldenScene golden = scene_of(config.picture, options, figure, framed);
    const Motion& motion = figure.rows.front().motion;
    const double alpha = config.alphas[column];
    golden.mesh = {motion.at(alpha), motion.morph->triangles()};
    golden.normals = area_weighted_normals(golden.mesh.V, golden.mesh.F) + motion.shading(alpha);
    settle(golden, name, row, figure.rows.front().cells.front());
    return golden;
}

std::vector<GoldenScene> look_scenes(const std::string& name, const FigureConfig& config) {
    const FigureOptions options = cell_options();
    const Figure figure = render_figure(config, options);
    const Mesh mesh = make_mesh(config.source, "source").mesh;
    std::vector<GoldenScene> scenes;
    for (const FigureRow& row : figure.rows) {
        const StageConfig& stage = config.stages[row.number];
        for (const FigureCell& cell : row.cells) {
            const PictureConfig picture = look_on_stage(stage, config.looks[cell.column]);
            GoldenScene golden = scene_of(picture, options, figure, {&mesh.V});
            golden.mesh = mesh;
            golden.normals = area_weighted_normals(mesh.V, mesh.F);
            settle(golden, name, row.number, cell);
            scenes.push_back(std::move(golden));
        }
    }
    return scenes;
}

/// The source as it is under the drawing of the first cell of the last row.
GoldenScene drawn_scene(const std::string& name, const FigureConfig& config) {
    FigureOptions options = cell_options();
    const std::size_t row = std::max<std::size_t>(1, config.rows.size()) - 1;
    options.rows = Selection(fmt::format("{}", row + 1));
    options.cells = Selection("1");
    const Figure figure = render_figure(config, options);
    const Mesh source = make_mesh(config.source, "source").mesh;
    std::vector<const Points*> framed{&source.V};
    Mesh target;
    if (config.show == Show::Features) {
        target = make_mesh(config.target, "target").mesh;
        framed.push_back(&target.V);
    }
    GoldenScene golden = scene_of(config.picture, options, figure, framed);
    golden.mesh = source;
    golden.normals = area_weighted_normals(source.V, source.F);
    settle(golden, name, row, figure.rows.front().cells.front());
    return golden;
}

}  // namespace

std::vector<GoldenScene> golden_scenes(const std::string& figure) {
    const FigureConfig config = golden::config(figure);
    switch (config.show) {
        case Show::Morph:
            return {morph_scene(figure, config)};
        case Show::Looks:
            return look_scenes(figure, config);
        case Show::Map:
        case Show::Features:
            return {drawn_scene(figure, config)};
        case Show::Borders:
            return {};
        case Show::Shape:
            break;
    }
    throw Error(figure + ": no golden shows a shape alone");
}

render::NoisyImage render_changed(const GoldenScene& scene, power::Change change, int spp,
                                  std::uint64_t seed) {
    render::RenderResult result = shoot(scene, change, spp, seed);
    render::Layers& layers = result.layers.value();
    return {std::move(result.image), std::move(layers.variance), std::move(layers.samples),
            render::Surfaces{std::move(layers.albedo), std::move(layers.shading_normal),
                             std::move(layers.depth)}};
}

}  // namespace automorph::bench
