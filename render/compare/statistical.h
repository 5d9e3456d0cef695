#pragma once

#include <optional>

#include "render/compare/comparison.h"

namespace automorph::render {

/// What the pixels look at: the layers of these names (see render/film/layers.h).
struct Surfaces {
    Image albedo, shading_normal, depth;
};

/// A picture with what is known of its noise: the layers `variance` and `samples`.
struct NoisyImage {
    Image image;                            ///< RGB, mean radiance of each pixel's samples
    Image variance;                         ///< RGB, of that mean, if the samples were independent
    Image samples;                          ///< 1 channel, at least 2
    std::optional<Surfaces> surfaces = {};  ///< compared, too, if both pictures have them
};

struct StatisticalOptions {
    /// Share of pictures of unchanged scenes that may be called different, by all tests together, in (0, 1).
    double false_alarm_rate = 0.01;
};

/// How small a change the noise of these two pictures leaves visible.
struct Sensitivity {
    double even_change = 0.0;   ///< smallest relative change of all radiance that is found; infinite without
                                ///< any
    double local_change = 0.0;  ///< radiance by which 3 x 3 pixels must differ, median of those with noise
    double golden_error = 0.0, found_error = 0.0;  ///< root of the mean variance, in radiance
};

struct StatisticalComparison : Comparison {
    Sensitivity sensitivity;
};

/// Whether two pictures of different seeds show the same scene, told by their own noise.
///
/// Two kinds of tests, each on every channel and with its share of the false alarms:
/// - blocks of 8 x 8, of 32 x 32 pixels and the whole picture: |sum z| / sqrt(sum z^2) of the pixels'
///   differences in standard errors, z = (found - golden) / sigma. If nothing has changed and both pictures
///   have as many samples, z and -z are equally likely in each pixel, whatever the distribution of radiance;
///   then values above x have a probability of at most 2 exp(-x^2 / 2) [Hoeffding63]. Sees shading: small
///   changes that many pixels share. With other numbers of samples: as windows, below.
/// - windows of 1 and of 3 x 3 pixels, at all places: |sum of differences| / sqrt(sum of sigma^2), with the
///   same bound. It is proven where samples of the pictures may be exchanged and sigma^2 is twice as large;
///   as it is, means of independent samples stay below it in all heavy-tailed distributions that the tests
///   try, and stratified samples stay far below. Sees what is local: a normal, a triangle, an edge.
///
/// Where both pictures have `surfaces`, these are compared as well, since they have hardly any noise: the
/// mean normal in blocks of 8 x 8 and in windows, the mean albedo in blocks of 8 x 8 (where sample counts are
/// equal: by signs), with bounds of their variance in place of sigma^2 (surfaces.h), and the depth, which has
/// none.
///
/// sigma^2 is the larger of two estimates from both pictures' variances and sample counts: Welch's, v + v',
/// and the pooled one of all samples, difference included. A bright sample that only one of the pictures met
/// raises sigma with the difference, so z stays near 1: fireflies raise no alarm.
///
/// Noise of neighbouring pixels has to be independent. Pixels of render() are, with filters wider than a
/// pixel, too: each takes samples of its own (filter importance sampling) with its own random numbers.
/// Pictures whose samples are shared between pixels ("splatting") or that were smoothed are not.
///
/// Differences below 1e-5 of the radiance are taken as rounding.
/// @throws Error if sizes differ, if a pixel has fewer than 2 samples or a variance that is no number >= 0
/// @pre three channels, not empty; layers as large as their image
StatisticalComparison compare_statistical(const NoisyImage& golden, const NoisyImage& found,
                                          const StatisticalOptions& options = {});

}  // namespace automorph::render
