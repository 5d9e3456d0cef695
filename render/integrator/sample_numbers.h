#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "render/sampler/sobol.h"

namespace automorph::render {

/// What the pairs of random numbers of a path are for.
enum Pair : std::uint32_t {
    kPixel = 0,  ///< place in the pixel
    // Per scattering vertex; the first vertex takes 1 to 3, the second 4 to 6, ...
    kLight = 1,    ///< place on the light
    kScatter = 2,  ///< scattered direction
    kChoice = 3,   ///< which light; which kind of surface, then roulette
    kPairsPerVertex = 3,
    // Once per path, beyond those of any vertex.
    kLens = 0x10000000,
    kTime = 0x10000001,
};

/// The random numbers of one camera ray and its path. Those that nearly every path takes are computed for a
/// whole batch of samples.
class SampleNumbers {
public:
    static constexpr std::uint32_t kPrepared = 4;
    using Prepared =
        std::array<PixelSampler::Batch, kPrepared>;  ///< by pair; of samples first, first + 1, ...

    /// @param count   of the pairs that are prepared
    /// @param offset  of the sample in the batch
    SampleNumbers(const PixelSampler& pixel, const Prepared& prepared, std::uint32_t count,
                  std::uint32_t first, std::size_t offset)
        : pixel_(pixel), prepared_(prepared), count_(count), first_(first), offset_(offset) {}

    Sample2 operator()(std::uint32_t pair) const {
        if (pair < count_ && pair < kPrepared)
            return {prepared_[pair].u[offset_], prepared_[pair].v[offset_]};
        return pixel_(first_ + static_cast<std::uint32_t>(offset_), pair);
    }

private:
    const PixelSampler& pixel_;
    const Prepared& prepared_;
    std::uint32_t count_, first_;
    std::size_t offset_;
};

}  // namespace automorph::render
