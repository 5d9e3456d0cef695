#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>

#include "render/figure/figure.h"
#include "render/figure/mesh_source.h"
#include "render/figure/page.h"
#include "render/figure/panels.h"
#include "tests/catch.h"

using namespace automorph;

namespace {

const std::string kTinyPanels = R"(title: Tiny
source: {shape: ellipsoid, semi_axes: [1, 0.8, 0.5], triangles: 300, seed: 3}
target: {shape: star, triangles: 600, rotation: {axis: [1, 0, 0], degrees: 40}}
rows:
  - {label: sphere, alignment: none, interpolation: linear}
  - {label: turning, alignment: none, interpolation: slerp}
  - {label: features, alignment: features, domain: cut}
alphas: [0, 1]
picture: {width: 40, height: 32, spp: 2}
)";

/// Share of pixels that are not paper.
double inked(const render::Image& image) {
    int count = 0;
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) count += image.pixels[i] < 0.9f;
    return 3.0 * count / static_cast<double>(image.pixels.size());
}

std::vector<std::string> labels(const std::vector<FigureCell>& cells) {
    std::vector<std::string> result;
    for (const FigureCell& cell : cells) result.push_back(cell.label);
    return result;
}

nlohmann::json page_data(const FigureConfig& config, const Figure& figure) {
    const std::string page = page_html(config, figure),
                      begin = "<script type=\"application/json\" id=\"data\">";
    const std::size_t data = page.find(begin) + begin.size();
    return nlohmann::json::parse(page.substr(data, page.find("</script>", data) - data));
}

/// The upper half of an ellipsoid, so that it is a disk.
InputMesh dome() {
    MeshConfig config;
    config.shape = MeshConfig::Shape::Ellipsoid;
    config.semi_axes = {1, 0.7, 0.4};
    config.opening = 0.5;
    config.triangles = 800;
    return make_mesh(config, "dome");
}

render::Camera camera_at(const Eigen::Vector3d& position) {
    render::Camera camera;
    camera.position = position;
    camera.target = Eigen::Vector3d::Zero();
    camera.up = Eigen::Vector3d(0.2, 1, 0).normalized();
    return camera;
}

/// Facing of a shape on the page: the mean of its normals by area.
Eigen::Vector3d facing(const Mesh& mesh, const MapPose& pose) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (Eigen::Index f = 0; f < mesh.F.rows(); ++f) {
        const Eigen::Vector3d a = mesh.V.row(mesh.F(f, 0)), b = mesh.V.row(mesh.F(f, 1)),
                              c = mesh.V.row(mesh.F(f, 2));
        sum += (b - a).cross(c - a);
    }
    return pose.shape * sum.normalized();
}

}  // namespace

TEST_CASE("each morph has its maps as pictures, and its features where they aligned the maps") {
    const FigureConfig config = parse_config(kTinyPanels, "tiny.yaml");
    const Figure figure = render_figure(config);
    REQUIRE(figure.panels.size() == 2);  // two rows share a morph
    const MorphPanels &sphere = figure.panels[0], &cut = figure.panels[1];
    CHECK(labels(sphere.maps) ==
          std::vector<std::string>{"source, front of the sphere", "target, front of the sphere",
                                   "source, back of the sphere", "target, back of the sphere"});
    CHECK(sphere.features.empty());
    CHECK(labels(cut.maps) ==
          std::vector<std::string>{"source, half 1", "target, half 1", "source, half 2", "target, half 2"});
    CHECK(labels(cut.features) == std::vector<std::string>{"source", "target"});
    for (const MorphPanels* panels : {&sphere, &cut}) {
        for (const FigureCell& cell : panels->maps) {
            CHECK(cell.image.width == 320);
            // A map covers its domain: a disk in a square.
            CHECK(inked(cell.image) == Approx(3.14159265 / 4 * 0.97 * 0.97).epsilon(0.03));
        }
        CHECK(panels->maps[0].image.pixels != panels->maps[1].image.pixels);
        CHECK(panels->maps[0].image.pixels != panels->maps[2].image.pixels);
    }
    for (const FigureCell& cell : cut.features) {  // no larger than a cell
        CHECK(cell.image.width == 40);
        CHECK(cell.image.height == 32);
        CHECK(inked(cell.image) > 0.1);
    }

    const nlohmann::json data = page_data(config, figure);
    CHECK(data["morphs"][0]["map_pictures"].size() == 4);
    CHECK(data["morphs"][0]["feature_pictures"].empty());
    REQUIRE(data["morphs"][1]["feature_pictures"].size() == 2);
    for (const nlohmann::json& picture : data["morphs"][1]["map_pictures"])
        CHECK(picture["image"].get<std::string>().rfind("data:image/jpeg;base64,/9j/", 0) == 0);
    CHECK(data["seconds"]["panels"] == figure.panel_seconds);
}

TEST_CASE(
    "only what selected rows show is drawn, the same as in the whole figure, and nothing if not wanted") {
    const FigureConfig config = parse_config(kTinyPanels, "tiny.yaml");
    FigureOptions options;
    options.rows = Selection("2");
    options.threads = 1;
    const Figure whole = render_figure(config), part = render_figure(config, options);
    REQUIRE(part.panels.size() == 2);
    CHECK(part.panels[1].maps.empty());
    REQUIRE(part.panels[0].maps.size() == 4);
    for (std::size_t i = 0; i < 4; ++i)
        CHECK(part.panels[0].maps[i].image.pixels == whole.panels[0].maps[i].image.pixels);
    const nlohmann::json data = page_data(config, part);
    CHECK(data["morphs"][0]["map_pictures"].size() == 4);
    CHECK(data["morphs"][1]["map_pictures"].empty());

    options.panels = false;
    const Figure without = render_figure(config, options);
    CHECK(without.panels.empty());
    CHECK(without.rows[0].motion.morph->maps().empty());
    CHECK(without.rows[0].cells[0].image.pixels == part.rows[0].cells[0].image.pixels);
}

TEST_CASE("a map lies as its shape is seen, from behind where the camera sees the shape's back") {
    const InputMesh shape = dome();
    const ShapeMap map = map_shape(shape);
    const Eigen::Vector3d front =
        facing(map.mesh, {Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity()});
    for (const double side : {5.0, -5.0}) {
        const MapPose pose = upright_pose(map, camera_at(side * front));
        CHECK((pose.shape * pose.shape.transpose()).isApprox(Eigen::Matrix3d::Identity(), 1e-12));
        CHECK(pose.shape.determinant() == Approx(1.0));
        CHECK(facing(map.mesh, pose).z() == Approx(1.0));
        // The border lies in its shape's directions.
        const Points seen = (map.mesh.V.rowwise() - map.mesh.V.colwise().mean()) * pose.shape.transpose();
        double least = 1;
        for (const int v : map.loop) {
            const Eigen::Vector3d on_page = pose.rays * map.rays.row(v).transpose();
            least = std::min(
                least, on_page.head<2>().normalized().dot(seen.row(v).head<2>().transpose().normalized()));
        }
        CHECK(least > 0.9);
    }
}

TEST_CASE("the other shape's map is turned like the first, and lit as if it lay like the first shape") {
    const ShapeMap map = map_shape(dome());
    const MapPose pose = upright_pose(map, camera_at({1, 2, 6}));
    const Eigen::Matrix3d R =
        Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
    DomainMap turned = map;
    turned.mesh.V = map.mesh.V * R.transpose();
    const MapPose beside = pose_beside(pose, turned, R.transpose());
    CHECK(beside.rays == pose.rays);
    CHECK((beside.shape * R).isApprox(pose.shape, 1e-12));
    const FigureConfig config = parse_config(kTinyPanels, "tiny.yaml");
    const FigureOptions options;
    const Shooting shooting{.picture = config.picture,
                            .options = options,
                            .camera = camera_at({1, 2, 6}),
                            .bounds = {},
                            .width = 64,
                            .height = 64,
                            .spp = 1,
                            .sky = {}};
    const render::Image first = map_drawing(shooting, map, pose).image,
                        second = map_drawing(shooting, turned, beside).image;
    double largest = 0;
    for (std::size_t i = 0; i < first.pixels.size(); ++i)
        largest = std::max(largest, std::abs(static_cast<double>(first.pixels[i] - second.pixels[i])));
    CHECK(largest < 0.02);  // a step of 8 bits
}
