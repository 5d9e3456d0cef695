#pragma once

#include <vector>

/// When a picture of something that moves takes the places of its vertices, for Scene::move_mesh().
namespace automorph::render {

/// How many moments an exposure needs in which nothing turns by more than so many degrees: an odd number, 1
/// if nothing moves. Vertices go straight from one to the next; moments are at most 3 degrees apart, where a
/// chord leaves its arc by 0.00034 of the arc's radius, a tenth of a pixel of one that is 300 pixels wide.
/// Arcs that would need more than the 129 moments that Embree takes get these.
int shutter_steps(double degrees);

/// These moments, evenly from the opening to the closing, in frames from the picture's own moment, which is
/// the middle one.
/// @param shutter  share of the time between two frames during which the shutter is open, in [0, 1]
/// @param steps    shutter_steps()
std::vector<double> shutter_times(double shutter, int steps);

}  // namespace automorph::render
