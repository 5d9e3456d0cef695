#include <fmt/format.h>

#include "morph/mesh/geometry.h"
#include "render/figure/panels.h"

namespace automorph {
namespace {

using render::Canvas;

/// Dots and numbers on the vertices of a pictured shape.
class Marking {
public:
    Marking(const Shooting& shooting, const PicturedShape& shape)
        : shooting_(shooting),
          shape_(shape),
          camera_(shooting.camera, shooting.width, shooting.height),
          canvas_(shape.picture().image) {}

    /// Hidden vertices get no dot. @param text  in the dot; may be empty
    void mark(int vertex, double radius, const render::Color& fill, const std::string& text) {
        const auto place = camera_.project(shape_.mesh().V.row(vertex));
        if (!place || !shape_.sees(vertex)) return;
        canvas_.dot(*place, radius, fill, {drawing::kPaper, drawing::scaled(shooting_, 1.0 / 350, 0.7)});
        if (!text.empty()) texts_.push_back({*place, radius, text});
    }

    FigureCell cell(const std::string& label) const {
        FigureCell cell = shape_.picture();
        cell.image = canvas_.image();
        cell.layers.reset();
        cell.label = label;
        for (const Text& text : texts_) {
            const auto size = static_cast<int>(text.text.size() > 1 ? 1.1 * text.radius : 1.4 * text.radius);
            drawing::label(cell.image, text.dot, text.text, size, drawing::kPaper);
        }
        return cell;
    }

private:
    struct Text {
        Eigen::Vector2d dot;
        double radius;
        std::string text;
    };

    const Shooting& shooting_;
    const PicturedShape& shape_;
    render::PictureCamera camera_;
    Canvas canvas_;
    std::vector<Text> texts_;
};

Marking marked(const Shooting& shooting, const PicturedShape& shape,
               const std::vector<FeatureReport>& features, std::vector<int> FeatureReport::*candidates,
               int FeatureReport::Match::*vertex) {
    Marking marking(shooting, shape);
    const double radius = drawing::scaled(shooting, 1.0 / 46, 2.0);
    for (const FeatureReport& found : features) {
        for (const int v : found.*candidates) marking.mark(v, 0.35 * radius, drawing::kFaint, "");
    }
    std::size_t number = 0;
    for (const FeatureReport& found : features) {
        for (const FeatureReport::Match& match : found.matches) {
            marking.mark(match.*vertex, radius, drawing::distinct_color(number),
                         fmt::format("{}", number + 1));
            ++number;
        }
    }
    return marking;
}

}  // namespace

PicturedShape::PicturedShape(const Shooting& shooting, const Mesh& mesh)
    : mesh_(mesh),
      normals_(vertex_normals(mesh)),
      subject_(shooting, mesh.V, mesh.F),
      picture_(subject_.shoot(mesh.V, {})) {}

std::vector<FigureCell> feature_panels(const Shooting& shooting, const PicturedShape& source,
                                       const PicturedShape& target,
                                       const std::vector<FeatureReport>& features) {
    using Found = FeatureReport;
    return {
        marked(shooting, source, features, &Found::candidates_source, &Found::Match::source).cell("source"),
        marked(shooting, target, features, &Found::candidates_target, &Found::Match::target).cell("target")};
}

}  // namespace automorph
