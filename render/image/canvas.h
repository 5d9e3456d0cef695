#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "render/film/image.h"
#include "render/math/vec.h"

namespace automorph::render {

/// Lines, areas and dots drawn over a picture, anti-aliased. Coordinates are pixels from the top left corner
/// of the picture, x to the right, y downwards; colours are linear. The door to Cairo.
class Canvas {
public:
    struct Pen {
        Color color{0.0f, 0.0f, 0.0f};
        double width = 1.0;    ///< pixels; 0 draws nothing
        double opacity = 1.0;  ///< in [0, 1]
    };

    /// @param background  copied; it is kept with 8 bits per channel from here on
    /// @pre three channels, not empty
    explicit Canvas(const Image& background);
    ~Canvas();
    Canvas(Canvas&&) noexcept;
    Canvas& operator=(Canvas&&) noexcept;

    void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Pen& pen);
    void polyline(const std::vector<Eigen::Vector2d>& points, const Pen& pen);
    void polygon(const std::vector<Eigen::Vector2d>& points, const Color& fill, const Pen& outline);
    void dot(const Eigen::Vector2d& center, double radius, const Color& fill, const Pen& outline);

    Image image() const;  ///< what is drawn so far

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace automorph::render
