#include "render/sampler/sobol.h"

#include <cstring>

// Integers and exact conversions only, so that every instruction set gives the same bits. Sanitizers do not
// get along with the choice at start-up.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define AUTOMORPH_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define AUTOMORPH_CLONES
#endif

namespace automorph::render {
namespace {

// Eight numbers at once; GCC's and Clang's vector extension.
using Words = std::uint32_t __attribute__((vector_size(32)));
using Integers = std::int32_t __attribute__((vector_size(32)));
using Floats = float __attribute__((vector_size(32)));
constexpr std::size_t kLanes = 8;

// to_unit() of all, stored.
[[gnu::always_inline]] inline void store_units(const Words& bits, float* to) {
    const Floats units = __builtin_convertvector((Integers)(bits >> 8), Floats) * 0x1p-24f;
    std::memcpy(to, &units, sizeof units);
}

}  // namespace

AUTOMORPH_CLONES
void PixelSampler::operator()(std::uint32_t index, std::uint32_t pair, Batch& batch) const {
    const Seeds seeds = seeds_of(pair);
    for (std::uint32_t i = 0; i < kBatch; i += kLanes) {
        Words lanes = {0, 1, 2, 3, 4, 5, 6, 7};
        lanes += index + i;
        const Words shuffled = shuffle(lanes, seeds);
        store_units(first_bits(shuffled, seeds), &batch.u[i]);
        store_units(second_bits(shuffled, seeds), &batch.v[i]);
    }
}

}  // namespace automorph::render
