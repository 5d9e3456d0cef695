#pragma once

#include "render/figure/subject.h"

namespace automorph {

/// The surface of a row with all that the config puts on it, for cells and films alike.
class RowSubject {
public:
    /// @param scale  of the colours; none: the frames have no colours
    RowSubject(const Shooting& shooting, const FigureRow& row, const std::optional<ColorScale>& scale);

    /// What smooth shading of the next picture lacks: Motion::shading(), turned as the frame is.
    void correct_normals(const Points& corrections) { subject_.correct_normals(corrections); }

    /// Takes the picture of a frame.
    /// @param V        #V x 3: where its vertices are in the picture
    /// @param numbers  #V: color_field() of the frame; not looked at without a scale
    /// @param index    of a video: frames have independent noise
    FigureCell shoot(const Points& V, const Eigen::VectorXd& numbers,
                     const std::function<void(double)>& progress, std::uint32_t index = 0);

private:
    Subject subject_;
    const std::optional<ColorScale>& scale_;
};

}  // namespace automorph
