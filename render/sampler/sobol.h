#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace automorph::render {

struct Sample2 {
    float u, v;  ///< in [0, 1)
};

// The functions of bits take single words as well as vectors of words (sobol.cpp).

/// Bits in reverse order.
template <class Word>
[[gnu::always_inline]] inline Word reverse_bits(Word x) {
    x = (x << 16) | (x >> 16);
    x = ((x & 0x00ff00ffu) << 8) | ((x >> 8) & 0x00ff00ffu);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
    x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
    return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
}

/// The second dimension of Sobol's sequence for `index`, bits reversed: the Pascal matrix modulo 2, which is
/// a fivefold Kronecker product and so takes five steps instead of 32 [Ahmed24].
template <class Word>
[[gnu::always_inline]] inline Word sobol_second_reversed(Word index) {
    index ^= (index >> 1) & 0x55555555u;
    index ^= (index >> 2) & 0x33333333u;
    index ^= (index >> 4) & 0x0f0f0f0fu;
    index ^= (index >> 8) & 0x00ff00ffu;
    return index ^ (index >> 16);
}

/// Owen's nested scrambling on reversed bits: each output bit is the input bit flipped by a hash of the bits
/// below it (Laine and Karras' hash [Laine11] in Vegdahl's version, as in pbrt-v4).
template <class Word>
[[gnu::always_inline]] inline Word owen_scramble_reversed(Word x, std::uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/// A bijection of 64-bit integers that spreads every bit (the finaliser of SplitMix64).
inline std::uint64_t mix_bits(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    return x ^ (x >> 31);
}

/// The upper 24 bits as a number in [0, 1).
inline float to_unit(std::uint32_t bits) {
    return static_cast<float>(static_cast<std::int32_t>(bits >> 8)) * 0x1p-24f;  // signed: one instruction
}

/// The random numbers of one pixel: for each pair of dimensions Sobol's (0,2)-sequence, shuffled and
/// Owen-scrambled by hashes [Burley20]. Any 2^k successive samples (from a multiple of 2^k) of a pair, or of
/// one dimension, are stratified perfectly. Numbers depend on the arguments only.
class PixelSampler {
public:
    PixelSampler(std::uint64_t seed, std::uint32_t frame, std::uint32_t x, std::uint32_t y)
        : seed_(mix_bits(mix_bits(mix_bits(seed + 0x9e3779b97f4a7c15ull) + frame) +
                         ((static_cast<std::uint64_t>(y) << 32) | x))) {
        for (std::uint32_t pair = 0; pair < kKept; ++pair) kept_[pair] = make_seeds(pair);
    }

    /// Dimensions 2 * pair and 2 * pair + 1 of sample `index`.
    Sample2 operator()(std::uint32_t index, std::uint32_t pair) const {
        const Seeds seeds = seeds_of(pair);
        const std::uint32_t shuffled = shuffle(index, seeds);
        return {to_unit(first_bits(shuffled, seeds)), to_unit(second_bits(shuffled, seeds))};
    }

    static constexpr std::size_t kBatch = 16;
    struct Batch {
        std::array<float, kBatch> u, v;
    };

    /// The same for samples index ... index + kBatch - 1, at a third of the price or less.
    void operator()(std::uint32_t index, std::uint32_t pair, Batch& batch) const;

private:
    struct Seeds {
        std::uint32_t order, first, second;
    };

    Seeds seeds_of(std::uint32_t pair) const { return pair < kKept ? kept_[pair] : make_seeds(pair); }
    Seeds make_seeds(std::uint32_t pair) const {
        const std::uint64_t a = mix_bits(seed_ + (pair + 1) * 0x9e3779b97f4a7c15ull);
        const std::uint64_t b = mix_bits(a + 0x632be59bd9b4e019ull);
        return {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(a >> 32),
                static_cast<std::uint32_t>(b)};
    }
    template <class Word>
    [[gnu::always_inline]] static Word shuffle(Word index, const Seeds& seeds) {
        return reverse_bits(owen_scramble_reversed(reverse_bits(index), seeds.order));
    }
    // The first dimension of Sobol's sequence is the reversed index itself.
    template <class Word>
    [[gnu::always_inline]] static Word first_bits(Word shuffled, const Seeds& seeds) {
        return reverse_bits(owen_scramble_reversed(shuffled, seeds.first));
    }
    template <class Word>
    [[gnu::always_inline]] static Word second_bits(Word shuffled, const Seeds& seeds) {
        return reverse_bits(owen_scramble_reversed(sobol_second_reversed(shuffled), seeds.second));
    }

    static constexpr std::size_t kKept = 7;  // pairs that most samples of a pixel take: place, two vertices
    std::uint64_t seed_;
    std::array<Seeds, kKept> kept_;
};

}  // namespace automorph::render
