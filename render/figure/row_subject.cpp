#include "render/figure/row_subject.h"

namespace automorph {

RowSubject::RowSubject(const Shooting& shooting, const FigureRow& row, const std::optional<ColorScale>& scale)
    : subject_(shooting, row.motion.morph->endpoints().a, row.motion.morph->triangles()), scale_(scale) {
    subject_.mark(row.marked);
}

FigureCell RowSubject::shoot(const std::vector<Points>& steps, const Eigen::VectorXd& numbers,
                             const std::function<void(double)>& progress, std::uint32_t index) {
    if (scale_) subject_.color(numbers, *scale_);
    return subject_.shoot(steps, progress, index);
}

}  // namespace automorph
