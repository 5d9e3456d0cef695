#include "morph/features/plane_grid.h"

#include <algorithm>
#include <cmath>

namespace automorph {

PlaneGrid::PlaneGrid(const Points& rays, const std::vector<int>& members, double cell_width)
    : cells_(std::max(1, static_cast<int>(2.0 / cell_width))),
      width_(2.0 / cells_),
      first_(static_cast<std::size_t>(cells_ * cells_), -1),
      next_(static_cast<std::size_t>(rays.rows()), -1),
      previous_(next_.size(), -1),
      cell_of_(next_.size(), 0) {
    for (const int p : members) insert(cell(index(rays(p, 0)), index(rays(p, 1))), p);
}

int PlaneGrid::index(double coordinate) const {
    return std::clamp(static_cast<int>(std::floor((coordinate + 1.0) / width_)), 0, cells_ - 1);
}

void PlaneGrid::insert(std::size_t cell, int point) {
    const auto p = static_cast<std::size_t>(point);
    cell_of_[p] = cell;
    previous_[p] = -1;
    next_[p] = first_[cell];
    if (next_[p] >= 0) previous_[static_cast<std::size_t>(next_[p])] = point;
    first_[cell] = point;
}

void PlaneGrid::refile(const Points& rays, int point) {
    const auto p = static_cast<std::size_t>(point);
    const std::size_t now = cell(index(rays(point, 0)), index(rays(point, 1)));
    if (now == cell_of_[p]) return;
    (previous_[p] >= 0 ? next_[static_cast<std::size_t>(previous_[p])] : first_[cell_of_[p]]) = next_[p];
    if (next_[p] >= 0) previous_[static_cast<std::size_t>(next_[p])] = previous_[p];
    insert(now, point);
}

}  // namespace automorph
