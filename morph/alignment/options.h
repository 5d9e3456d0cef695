#pragma once

#include <vector>

namespace automorph {

/// One step from coarse to fine of the non-rigid alignment.
struct AlignmentLevel {
    double position, normal;  ///< sigma of positions, in diagonals of the target's box, and of unit normals
    double stiffness;         ///< omega: how much the prior weighs against the matches
    int rounds;               ///< of matching and solving

    bool operator==(const AlignmentLevel&) const = default;
};

/// The dense alignment. Lengths are in diagonals of the target's box, so that no option depends on units.
struct NonRigidOptions {
    std::vector<AlignmentLevel> levels = {
        {.08, .6, .48, 3},    {.05, .5, .16, 3},    {.035, .4, .048, 4},
        {.025, .35, .016, 4}, {.018, .3, .0048, 4}, {.012, .3, .0016, 4},
    };
    double stiffness = 1.0;        ///< factor on that of every level
    int rounds = 0;                ///< of every level; 0: as the levels say
    double membrane = 1e-2;        ///< parts of the prior: against stretching,
    double bending = 1e-4;         ///< against bending,
    double border_bending = 3e-4;  ///< and against bends of the borders
    double border = 0.2;           ///< weight of a border vertex' pull to the other border, per length
    double slide = 0.95;           ///< share of that pull which is not felt along the border
    double plastic = 0.7;          ///< how much of the motion so far becomes the shape at rest
    int similarity_rounds = 8;     ///< of turning, shifting and scaling before anything bends
    int vertices = 5000;           ///< a mesh of half as many again or more is thinned out to so many
    int coarse_levels = 3;         ///< so many levels see no more than still thinner meshes show,
    int coarse_vertices = 2500;    ///< of so many vertices
    bool normals = true;           ///< matches heed normals
    double limbs = 3.0;  ///< pull on limbs at the coarse levels, times that of sure matches; 0: none
    bool directional_trust = true;  ///< matches pull weakly along surfaces that look alike along them

    bool operator==(const NonRigidOptions&) const = default;
};

}  // namespace automorph
