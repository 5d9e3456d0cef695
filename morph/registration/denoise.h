#pragma once

#include <optional>

#include "morph/mesh/mesh.h"

namespace automorph {

/// How crumpled a surface is: the median over its vertices of 1 - |sum of area vectors| / sum of areas over
/// the incident triangles. Smooth meshes have < 0.04 and parts full of sharp edges < 0.3; noise as large as
/// the edges gives 0.5 to 0.75. No scale, 0..1.
double crumpling(const Mesh& mesh);

/// A smoothed copy of a mesh that noise has crumpled; nothing for any other. On a crumpled surface areas and
/// normals say nothing about the shape, so that samples need it smoothed. Each round moves every vertex to
/// the mean of its neighbours, until the surface is smooth enough. The motion found is the same; the copy is
/// used for nothing else.
std::optional<Mesh> denoised(const Mesh& mesh);

}  // namespace automorph
