#include <fmt/format.h>

#include "morph/mesh/geometry.h"
#include "render/figure/panels.h"

namespace automorph {
namespace {

using render::Canvas;

/// A picture with dots on vertices of its surface.
class MarkedPicture {
public:
    MarkedPicture(const Shooting& shooting, const Mesh& mesh)
        : shooting_(shooting),
          mesh_(mesh),
          normals_(vertex_normals(mesh)),
          subject_(shooting, mesh.V, mesh.F),
          camera_(shooting.camera, shooting.width, shooting.height),
          cell_(subject_.shoot(mesh.V, {})),
          canvas_(cell_.image) {}

    /// Hidden vertices get no dot. @param text  in the dot; may be empty
    void mark(int vertex, double radius, const render::Color& fill, const std::string& text) {
        const auto place = camera_.project(mesh_.V.row(vertex));
        if (!place || !subject_.sees(mesh_.V.row(vertex), normals_.row(vertex))) return;
        canvas_.dot(*place, radius, fill, {drawing::kPaper, drawing::scaled(shooting_, 1.0 / 350, 0.7)});
        if (!text.empty()) texts_.push_back({*place, radius, text});
    }

    FigureCell cell() && {
        cell_.image = canvas_.image();
        cell_.layers.reset();
        for (const Text& text : texts_) {
            const auto size = static_cast<int>(text.text.size() > 1 ? 1.1 * text.radius : 1.4 * text.radius);
            drawing::label(cell_.image, text.dot, text.text, size, drawing::kPaper);
        }
        return std::move(cell_);
    }

private:
    struct Text {
        Eigen::Vector2d dot;
        double radius;
        std::string text;
    };

    const Shooting& shooting_;
    const Mesh& mesh_;
    Points normals_;
    Subject subject_;
    render::PictureCamera camera_;
    FigureCell cell_;
    Canvas canvas_;
    std::vector<Text> texts_;
};

FigureCell marked(const Shooting& shooting, const Mesh& mesh, const std::vector<FeatureReport>& features,
                  std::vector<int> FeatureReport::*candidates, int FeatureReport::Match::*vertex) {
    MarkedPicture picture(shooting, mesh);
    const double radius = drawing::scaled(shooting, 1.0 / 46, 2.0);
    for (const FeatureReport& found : features) {
        for (const int v : found.*candidates) picture.mark(v, 0.35 * radius, drawing::kFaint, "");
    }
    std::size_t number = 0;
    for (const FeatureReport& found : features) {
        for (const FeatureReport::Match& match : found.matches) {
            picture.mark(match.*vertex, radius, drawing::distinct_color(number),
                         fmt::format("{}", number + 1));
            ++number;
        }
    }
    return std::move(picture).cell();
}

}  // namespace

std::vector<FigureCell> feature_panels(const Shooting& shooting, const InputMesh& source,
                                       const InputMesh& target, const std::vector<FeatureReport>& features) {
    std::vector<FigureCell> cells;
    cells.push_back(marked(shooting, source.mesh, features, &FeatureReport::candidates_source,
                           &FeatureReport::Match::source));
    cells.back().label = "source";
    cells.push_back(marked(shooting, target.mesh, features, &FeatureReport::candidates_target,
                           &FeatureReport::Match::target));
    cells.back().label = "target";
    return cells;
}

}  // namespace automorph
