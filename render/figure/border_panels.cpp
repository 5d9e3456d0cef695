#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/figure/panels.h"

namespace automorph {
namespace {

using render::Canvas;

constexpr double kFullTurn = 6.283185307179586;
const render::Color kOfSource{0.02f, 0.14f, 0.45f}, kOfTarget{0.62f, 0.14f, 0.01f};

/// One border of the union as it is drawn.
struct Side {
    const std::vector<BorderSite>& sites;
    render::Color own, other;
    const char* name;  ///< of a vertex, before its number
};

Side side_of(const BorderUnion& border, bool source) {
    if (source) return {border.source, kOfSource, kOfTarget, "h\u1d43"};
    return {border.target, kOfTarget, kOfSource, "h\u1d47"};
}

/// A number as Unicode subscripts.
std::string subscript(int number) {
    std::string text;
    constexpr std::array kDigits{"\u2080", "\u2081", "\u2082", "\u2083", "\u2084",
                                 "\u2085", "\u2086", "\u2087", "\u2088", "\u2089"};
    for (const char digit : fmt::format("{}", number))
        text += kDigits.at(static_cast<std::size_t>(digit - '0'));
    return text;
}

/// Angle 0 is at the top, where the control vertices are; angles run counter-clockwise.
Eigen::Vector2d direction(double angle) {
    return {-std::sin(angle), -std::cos(angle)};
}

/// Own vertices are filled; inserted ones are hollow in the colour of the border they come from; those that
/// both borders have are black.
void draw_vertex(Canvas& canvas, const Eigen::Vector2d& at, double radius, const Side& side,
                 const Side& opposite, std::size_t k) {
    const bool own = side.sites[k].is_vertex(), shared = own && opposite.sites[k].is_vertex();
    if (own) {
        canvas.dot(at, radius, shared ? drawing::kInk : side.own, {drawing::kPaper, 0.0});
    } else {
        canvas.dot(at, radius, drawing::kPaper, {side.other, 0.45 * radius});
    }
}

FigureCell circle(const Shooting& shooting, const BorderUnion& border, bool source) {
    const Side side = side_of(border, source), opposite = side_of(border, !source);
    const double radius =
        0.5 * std::min(shooting.width, shooting.height) * (1.0 - shooting.picture.margin) * 0.86;
    const Eigen::Vector2d center(0.5 * shooting.width, 0.5 * shooting.height);
    FigureCell cell;
    Canvas canvas(render::Image(shooting.width, shooting.height, 3, 1.0f));
    const double dot =
        std::min(drawing::scaled(shooting, 1.0 / 110, 1.0), 0.4 * kFullTurn * radius / border.size());
    const double thin = drawing::scaled(shooting, 1.0 / 500, 0.5);
    canvas.dot(center, radius, drawing::kPaper, {drawing::kInk, thin});
    // Own vertices' spokes point inwards, inserted ones' outwards: dense borders stay readable.
    for (std::size_t k = 0; k < side.sites.size(); ++k) {
        const Eigen::Vector2d out = direction(border.angles[static_cast<Eigen::Index>(k)]);
        const bool own = side.sites[k].is_vertex();
        const double reach = own ? 0.93 : 1.05;
        canvas.line(center + radius * out, center + reach * radius * out,
                    {own ? side.own : side.other, thin});
    }
    for (std::size_t k = 0; k < side.sites.size(); ++k) {
        const Eigen::Vector2d out = direction(border.angles[static_cast<Eigen::Index>(k)]);
        draw_vertex(canvas, center + radius * out, dot, side, opposite, k);
    }
    const Eigen::Vector2d top = center + radius * direction(0.0);
    canvas.dot(top, 1.8 * dot, drawing::kInk, {drawing::kPaper, 0.5 * dot});
    cell.image = canvas.image();
    const int size = static_cast<int>(drawing::scaled(shooting, 1.0 / 24, 7));
    const int own = source ? border.source_size : border.target_size;
    const double line = 1.5 * size;
    drawing::label(cell.image, top + Eigen::Vector2d(0, 0.24 * radius), "control vertex", size);
    drawing::label(cell.image, center + Eigen::Vector2d(0, -line), fmt::format("{} own vertices", own), size,
                   side.own);
    drawing::label(cell.image, center, fmt::format("{} inserted", border.size() - own), size, side.other);
    drawing::label(cell.image, center + Eigen::Vector2d(0, line),
                   fmt::format("{} of both borders", border.shared), size);
    cell.label = source ? "border of the source" : "border of the target";
    return cell;
}

/// Number of the loop's vertex, counted from the control vertex on.
int number_on(const Side& side, std::size_t k) {
    return static_cast<int>(std::count_if(side.sites.begin(),
                                          side.sites.begin() + static_cast<std::ptrdiff_t>(k),
                                          [](const BorderSite& site) { return site.is_vertex(); }));
}

/// The first of `count` neighbours that lie apart most evenly: of all such runs, none has a wider narrowest
/// gap for its length.
int clearest_run(const Eigen::VectorXd& angles, int count) {
    int best = 0;
    double widest = -1.0;
    for (int first = 0; first + count <= angles.size(); ++first) {
        const Eigen::VectorXd gaps = angles.segment(first + 1, count - 1) - angles.segment(first, count - 1);
        const double narrowest = gaps.minCoeff() / (angles[first + count - 1] - angles[first]);
        if (narrowest > widest) {
            widest = narrowest;
            best = first;
        }
    }
    return best;
}

/// A part of both borders, enlarged: the source's above the target's, with what is inserted into each joined
/// to where it comes from.
FigureCell enlarged(const Shooting& shooting, const BorderUnion& border) {
    constexpr int kShown = 12;
    const int shown = std::min(kShown, border.size()), start = clearest_run(border.angles, shown);
    const double first = border.angles[start], last = border.angles[start + shown - 1];
    const double margin = 0.5 * shooting.picture.margin + 0.04;
    const auto x = [&](int k) {
        return shooting.width *
               (margin + (1.0 - 2.0 * margin) * (border.angles[start + k] - first) / (last - first));
    };
    const double above = 0.36 * shooting.height, below = 0.64 * shooting.height;
    const double dot = drawing::scaled(shooting, 1.0 / 75, 2.0),
                 thin = drawing::scaled(shooting, 1.0 / 400, 0.5);
    FigureCell cell;
    Canvas canvas(render::Image(shooting.width, shooting.height, 3, 1.0f));
    for (const double y : {above, below}) canvas.line({x(0), y}, {x(shown - 1), y}, {drawing::kInk, thin});
    for (int k = 0; k < shown; ++k) canvas.line({x(k), above}, {x(k), below}, {drawing::kFaint, 0.7 * thin});
    const Side a = side_of(border, true), b = side_of(border, false);
    for (int k = 0; k < shown; ++k) {
        draw_vertex(canvas, {x(k), above}, dot, a, b, static_cast<std::size_t>(start + k));
        draw_vertex(canvas, {x(k), below}, dot, b, a, static_cast<std::size_t>(start + k));
    }
    cell.image = canvas.image();
    const int size = static_cast<int>(drawing::scaled(shooting, 1.0 / 22, 7));
    // Labels go to two heights in turn, so that neighbours do not touch.
    for (const bool source : {true, false}) {
        const Side& side = source ? a : b;
        int labelled = 0;
        for (int k = 0; k < shown; ++k) {
            const auto index = static_cast<std::size_t>(start + k);
            if (!side.sites[index].is_vertex()) continue;
            const double away = dot + (labelled++ % 2 == 0 ? 1.2 : 2.6) * size;
            drawing::label(cell.image, {x(k), source ? above - away : below + away},
                           side.name + subscript(number_on(side, index)), size, side.own);
        }
    }
    drawing::label(cell.image, {0.5 * shooting.width, above - 5.0 * size}, "source", size, a.own);
    drawing::label(cell.image, {0.5 * shooting.width, below + 5.0 * size}, "target", size, b.own);
    cell.label = "part of both, enlarged";
    return cell;
}

}  // namespace

std::vector<FigureCell> border_panels(const Shooting& shooting, const BorderInsertion& insertion) {
    std::vector<FigureCell> cells;
    cells.push_back(circle(shooting, insertion.border, true));
    cells.push_back(circle(shooting, insertion.border, false));
    cells.push_back(enlarged(shooting, insertion.border));
    return cells;
}

}  // namespace automorph
