#pragma once

#include <array>
#include <cstdint>

#include "render/compare/statistical.h"
#include "render/film/filter.h"

/// Small scenes, and small changes of them that a comparison has to see.
namespace power {

enum class Body {
    Clay,   ///< diffuse, in the studio
    Metal,  ///< glossy copper, in the studio
    Glass   ///< on a coloured ground under a small light: its caustics are made of fireflies
};
constexpr std::array<Body, 3> kBodies{Body::Clay, Body::Metal, Body::Glass};
const char* name(Body body);

enum class Change {
    None,
    Light,         ///< lamps 2 % brighter, the sky as it was
    Albedo,        ///< base colour of the body 1 % brighter
    Normal,        ///< one vertex normal of 642 turned round
    DarkTriangle,  ///< one triangle of 1280 with half the base colour
    Ring,          ///< the triangles about one vertex removed
    Camera         ///< turned by 0.1 degrees: half a pixel of a 96 pixels wide picture
};
constexpr std::array<Change, 6> kChanges{Change::Light,        Change::Albedo, Change::Normal,
                                         Change::DarkTriangle, Change::Ring,   Change::Camera};
const char* name(Change change);

struct Settings {
    int size = 64;  ///< pixels, width and height
    int spp = 32;
    std::uint64_t seed = 1;
    automorph::render::Filter filter = automorph::render::Filter::BlackmanHarris;
    double adaptive_error = 0.0;
};

automorph::render::NoisyImage picture(Body body, Change change, const Settings& settings);

}  // namespace power
