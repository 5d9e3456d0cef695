#pragma once

#include <array>
#include <cstdint>

#include "render/compare/statistical.h"
#include "render/film/filter.h"
#include "tests/render/compare/power_changes.h"

/// Small scenes for the changes that a comparison has to see.
namespace power {

enum class Body {
    Clay,   ///< diffuse, in the studio
    Metal,  ///< glossy copper, in the studio
    Glass   ///< on a coloured ground under a small light: its caustics are made of fireflies
};
constexpr std::array<Body, 3> kBodies{Body::Clay, Body::Metal, Body::Glass};
const char* name(Body body);

struct Settings {
    int size = 64;  ///< pixels, width and height
    int spp = 32;
    std::uint64_t seed = 1;
    automorph::render::Filter filter = automorph::render::Filter::BlackmanHarris;
    double adaptive_error = 0.0;
};

automorph::render::NoisyImage picture(Body body, Change change, const Settings& settings);

}  // namespace power
