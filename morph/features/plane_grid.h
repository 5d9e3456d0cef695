#pragma once

#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

/// Moving points in square cells over [-1, 1]^2: those near a place without a look at all. Rows of `rays` are
/// (x, y, 1).
class PlaneGrid {
public:
    /// @param members  the points to file
    PlaneGrid(const Points& rays, const std::vector<int>& members, double cell_width);

    /// Files a point anew after it has moved.
    void refile(const Points& rays, int point);

    /// Calls visit(point) for every point of the cells that the square of half-width `reach` around a place
    /// touches.
    template <typename Visit>
    void near(double x, double y, double reach, const Visit& visit) const {
        for (int row = index(y - reach); row <= index(y + reach); ++row) {
            for (int column = index(x - reach); column <= index(x + reach); ++column) {
                for (int p = first_[cell(column, row)]; p >= 0; p = next_[static_cast<std::size_t>(p)])
                    visit(p);
            }
        }
    }

private:
    int index(double coordinate) const;
    std::size_t cell(int column, int row) const { return static_cast<std::size_t>(row * cells_ + column); }
    void insert(std::size_t cell, int point);

    int cells_;  ///< along each side
    double width_;
    std::vector<int> first_;            ///< per cell, -1 if empty
    std::vector<int> next_, previous_;  ///< per point, within its cell
    std::vector<std::size_t> cell_of_;
};

}  // namespace automorph
