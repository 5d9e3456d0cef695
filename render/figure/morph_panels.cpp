#include "render/figure/morph_panels.h"

#include <algorithm>
#include <cmath>

#include "render/figure/panels.h"

namespace automorph {
namespace {

constexpr int kSide = 320;           // longer side, pixels
constexpr double kMapMargin = 0.03;  // around maps, relative to half the picture
constexpr int kMostSpp = 16;         // paths per pixel: the pictures are denoised

/// Source -> target, as it was registered.
Eigen::Matrix3d registered_rotation(const RegistrationReport& found) {
    return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(found.rotation.data());
}

void draw_pair(const Shooting& shooting, const DomainMaps& maps, const Eigen::Matrix3d& R,
               std::vector<FigureCell>& cells) {
    const MapPose source = upright_pose(maps.source, shooting.camera),
                  target = pose_beside(source, maps.target, R.transpose());
    const auto add = [&](const DomainMap& map, const MapPose& pose, const std::string& label) {
        cells.push_back(map_drawing(shooting, map, pose));
        cells.back().label = label;
    };
    if (maps.source.on_disk()) {
        const std::string part = maps.part.empty() ? "" : ", " + maps.part;
        add(maps.source, source, "source" + part);
        add(maps.target, target, "target" + part);
    } else {
        add(maps.source, source, "source, front of the sphere");
        add(maps.target, target, "target, front of the sphere");
        add(maps.source, source.from_behind(), "source, back of the sphere");
        add(maps.target, target.from_behind(), "target, back of the sphere");
    }
}

std::vector<FigureCell> draw_maps(const FigureConfig& config, const FigureOptions& options,
                                  const render::Camera& camera, const Morph& morph) {
    PictureConfig picture = config.picture;
    picture.margin = kMapMargin;
    const Shooting shooting{.picture = picture,
                            .options = options,
                            .camera = camera,
                            .bounds = {},
                            .width = kSide,
                            .height = kSide,
                            .spp = 1,
                            .sky = {}};
    std::vector<FigureCell> cells;
    for (const DomainMaps& maps : morph.maps())
        draw_pair(shooting, maps, registered_rotation(morph.report().registration), cells);
    return cells;
}

/// In the shape of a cell, and not larger.
Film feature_film(const PictureConfig& picture, const FigureOptions& options) {
    const double width = picture.width * options.scale, height = picture.height * options.scale;
    const double scale = std::min(1.0, kSide / std::max(width, height));
    const auto pixels = [&](double length) {
        return std::max(1, static_cast<int>(std::lround(scale * length)));
    };
    return {pixels(width), pixels(height), std::min(kMostSpp, options.spp.value_or(picture.spp))};
}

}  // namespace

MorphPanels morph_panels(const FigureConfig& config, const FigureOptions& options,
                         const render::Camera& camera, const ShapePair& shapes, const Morph& morph) {
    MorphPanels panels;
    panels.maps = draw_maps(config, options, camera, morph);
    if (morph.report().features.empty()) return panels;
    PictureConfig picture = config.picture;
    picture.denoise = true;
    const Points &source = shapes.source.mesh.V, &target = shapes.target.mesh.V;
    const Shooting shooting =
        shooting_of(picture, options, feature_film(picture, options), {&source, &target});
    panels.features = feature_panels(shooting, PicturedShape(shooting, shapes.source.mesh),
                                     PicturedShape(shooting, shapes.target.mesh), morph.report().features);
    return panels;
}

}  // namespace automorph
