#pragma once

#include <Eigen/Core>

namespace automorph {

/// A vertex of a map: a ray from the origin. A disk point (x, y) is (x, y, 1), a sphere point is itself; only
/// the direction counts.
using Ray = Eigen::Vector3d;

/// Sign of det[a b c], exact on the given doubles: +1 if a, b, c turn counter-clockwise seen from outside
/// (on z = 1: the plane's orient2d), -1 if clockwise, 0 if they lie on one great circle (line).
int orientation(const Ray& a, const Ray& b, const Ray& c);

/// det[a b c] to within a few units in the last place of the exact value, however close to zero it is.
double determinant(const Ray& a, const Ray& b, const Ray& c);

}  // namespace automorph
