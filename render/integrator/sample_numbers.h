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

/// Most paths that may go on from the first surface.
inline constexpr std::uint32_t kMostBranches = 4;

/// The random numbers of one camera ray and the paths that go on from its first surface. Those that nearly
/// every path takes are computed for a whole batch of samples.
class SampleNumbers {
public:
    static constexpr std::uint32_t kPrepared = 4;
    struct Prepared {
        std::array<PixelSampler::Batch, kPrepared> pairs;  ///< of samples first, first + 1, ...
        std::uint32_t branches = 1;  ///< if more: so many batches of both pairs below are prepared, too
        std::array<PixelSampler::Batch, kMostBranches> scatter, choice;  ///< at the first surface
    };

    /// @param count   of the pairs that are prepared
    /// @param offset  of the sample in the batch
    SampleNumbers(const PixelSampler& pixel, const Prepared& prepared, std::uint32_t count,
                  std::uint32_t first, std::size_t offset)
        : pixel_(pixel), prepared_(prepared), count_(count), first_(first), offset_(offset) {}

    Sample2 operator()(std::uint32_t pair) const {
        if (pair < count_ && pair < kPrepared) return at(prepared_.pairs[pair], offset_);
        return pixel_(first_ + static_cast<std::uint32_t>(offset_), pair);
    }

    /// Of path `which` of the `of` that share the first surface; `of` times as many, stratified as well.
    Sample2 branch(std::uint32_t pair, std::uint32_t which, std::uint32_t of) const {
        if (of == 1) return (*this)(pair);
        if (of == prepared_.branches && (pair == kScatter || pair == kChoice)) {
            const std::size_t place = offset_ * of + which;
            const auto& batches = pair == kScatter ? prepared_.scatter : prepared_.choice;
            return at(batches[place / PixelSampler::kBatch], place % PixelSampler::kBatch);
        }
        return pixel_((first_ + static_cast<std::uint32_t>(offset_)) * of + which, pair);
    }

private:
    static Sample2 at(const PixelSampler::Batch& batch, std::size_t place) {
        return {batch.u[place], batch.v[place]};
    }

    const PixelSampler& pixel_;
    const Prepared& prepared_;
    std::uint32_t count_, first_;
    std::size_t offset_;
};

}  // namespace automorph::render
