#pragma once

#include "render/film/image.h"

namespace automorph::render {

/// What is known of each pixel beside its radiance. Albedo and normals are means over the pixel's samples,
/// zero where a sample met nothing; depth, position and numbers are those of the ray through the pixel's
/// middle at the begin of the exposure, since their means would belong to no place.
struct Layers {
    Image albedo;            ///< RGB, base colour of the first surface
    Image shading_normal;    ///< XYZ, world frame, towards the camera
    Image geometric_normal;  ///< XYZ, of the triangle
    Image depth;             ///< 1 channel, along the view, scene units; infinite where there is nothing
    Image position;          ///< XYZ, world frame; zero where there is nothing
    Image object;            ///< 1 channel, number of the mesh; -1 where there is nothing
    Image face;              ///< 1 channel, number of the triangle in its mesh, exact below 2^24; -1 likewise
    Image variance;          ///< RGB, of the pixel's mean radiance, if its samples were independent
    Image samples;           ///< 1 channel, good samples
};

}  // namespace automorph::render
