#pragma once

#include "render/film/image.h"
#include "render/film/layers.h"

namespace automorph::render {

struct DenoiseOptions {
    int radius = 8;        ///< of the window whose pixels are averaged, pixels
    int patch = 2;         ///< of the patches by which pixels are compared, pixels
    float color = 0.6f;    ///< how many standard deviations of noise patches may differ
    float normal = 0.25f;  ///< difference of normals (chord, unit vectors) at which pixels cease to be alike
    float albedo = 0.08f;  ///< likewise of albedos
};

/// A preview without noise: each pixel becomes the mean of those in its window that look alike but for noise.
///
/// Method   non-local means with the pixels' own variances [Rousselle12], weighted by the features of the
///          first surface [Rousselle13]: normal and albedo.
/// Limits   biased; shadows and reflections that are finer than the noise are lost. What has no variance
///          stays as it is.
///
/// Deterministic: the bits do not depend on the number of threads.
/// @param image   radiance, three channels
/// @param layers  of the same rendering
/// @throws Error if the sizes differ
Image denoise(const Image& image, const Layers& layers, const DenoiseOptions& options = {});

}  // namespace automorph::render
