#include "render/studio/backdrop.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/math/angle.h"

namespace automorph::render {
namespace {

// Lengths in radii of the shape's bounds.
constexpr double kFar = 60.0;     // beyond, nobody looks
constexpr double kSquare = 0.4;   // side of a square
constexpr int kSquares = 24;      // to each side of the middle
constexpr double kBehind = 3.2;   // where the paper begins to rise: shadows still lie on the floor
constexpr double kBend = 3.0;     // radius of the rise
constexpr int kBendSteps = 24;    // of the quarter circle
constexpr double kWhole = 3.0;    // so far from the middle squares have their full contrast
constexpr double kFaded = 7.5;    // and from here on none
constexpr float kDarker = 0.45f;  // albedo of dark squares relative to light ones

/// A line across the floor: how far behind the shape and how high, and the normal there.
struct Line {
    double behind, height;
    double normal_behind, normal_height;
};

std::vector<Line> profile(bool wall) {
    std::vector<Line> lines{{-kFar, 0, 0, 1}};
    const double last = wall ? kBehind : kSquares * kSquare;
    for (int i = -kSquares; i * kSquare < last; ++i) lines.push_back({i * kSquare, 0, 0, 1});
    lines.push_back({last, 0, 0, 1});
    if (!wall) {
        lines.push_back({kFar, 0, 0, 1});
        return lines;
    }
    constexpr double kQuarter = 1.57079632679489662;
    for (int i = 1; i <= kBendSteps; ++i) {
        const SineCosine turn = sine_and_cosine(kQuarter * i / kBendSteps);
        lines.push_back({kBehind + kBend * turn.sine, kBend * (1 - turn.cosine), -turn.sine, turn.cosine});
    }
    lines.push_back({kBehind + kBend, kFar, -1, 0});
    return lines;
}

std::vector<double> columns() {
    std::vector<double> places{-kFar};
    for (int i = -kSquares; i <= kSquares; ++i) places.push_back(i * kSquare);
    places.push_back(kFar);
    return places;
}

/// Contrast of the squares at a distance from the middle: 1 near it, falling smoothly to 0.
double contrast(double distance) {
    const double t = std::clamp((distance - kWhole) / (kFaded - kWhole), 0.0, 1.0);
    return 1 - t * t * (3 - 2 * t);
}

Color color_of(const BackdropOptions& options, std::size_t row, std::size_t column, double distance) {
    const bool dark = options.squares && (row + column) % 2 == 0;
    return dark ? Color(options.color * (1 - (1 - kDarker) * static_cast<float>(contrast(distance))))
                : options.color;
}

}  // namespace

Backdrop make_backdrop(const FloorPlace& place, const BackdropOptions& options) {
    const std::vector<Line> lines = profile(options.wall);
    const std::vector<double> across = columns();
    const auto cells = static_cast<Eigen::Index>((lines.size() - 1) * (across.size() - 1));
    // Cells have their own corners, so that colours end at their edges.
    Backdrop sheet{Points(4 * cells, 3), Triangles(2 * cells, 3), {}};
    Points normals(4 * cells, 3), colors(4 * cells, 3);
    Eigen::Index cell = 0;
    for (std::size_t row = 0; row + 1 < lines.size(); ++row) {
        for (std::size_t column = 0; column + 1 < across.size(); ++column, ++cell) {
            const double middle_behind = 0.5 * (lines[row].behind + lines[row + 1].behind);
            const double middle_across = 0.5 * (across[column] + across[column + 1]);
            const Color color = color_of(options, row, column, std::hypot(middle_behind, middle_across));
            for (int corner = 0; corner < 4; ++corner) {
                const Line& line = lines[row + static_cast<std::size_t>(corner / 2)];
                const double x = across[column + static_cast<std::size_t>(corner % 2)];
                sheet.V.row(4 * cell + corner) =
                    place.below +
                    place.radius * (x * place.right + line.behind * place.level + line.height * place.up);
                normals.row(4 * cell + corner) =
                    line.normal_behind * place.level + line.normal_height * place.up;
                colors.row(4 * cell + corner) = color.matrix().cast<double>();
            }
            const int first = static_cast<int>(4 * cell);
            sheet.F.row(2 * cell) << first, first + 1, first + 3;
            sheet.F.row(2 * cell + 1) << first, first + 3, first + 2;
        }
    }
    sheet.options.normals = Normals::Smooth;
    sheet.options.vertex_normals = normals;
    sheet.options.vertex_colors = colors;
    return sheet;
}

}  // namespace automorph::render
