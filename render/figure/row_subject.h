#pragma once

#include "render/figure/subject.h"

namespace automorph {

/// The surface of a row with all that the config puts on it, for cells and films alike.
class RowSubject {
public:
    /// @param scale  of the colours; none: the frames have no colours
    RowSubject(const Shooting& shooting, const FigureRow& row, const std::optional<ColorScale>& scale);

    /// What smooth shading of the next picture lacks at each time step: Motion::shading(), turned as the
    /// frame is.
    void correct_normals(const std::vector<Points>& steps) { subject_.correct_normals(steps); }

    /// Takes the picture of a frame.
    /// @param steps    #V x 3: where its vertices are in the picture, at each time step of the exposure
    /// @param numbers  #V: color_field() of the frame, which holds for the exposure; not looked at without a
    ///                 scale
    /// @param index    of a video: frames have independent noise
    FigureCell shoot(const std::vector<Points>& steps, const Eigen::VectorXd& numbers,
                     const std::function<void(double)>& progress, std::uint32_t index = 0);

private:
    Subject subject_;
    std::optional<ColorScale> scale_;
};

}  // namespace automorph
