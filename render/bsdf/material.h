#pragma once

#include "render/math/vec.h"

namespace automorph::render {

/// What a surface is made of, in the parameters of glTF 2.0 and of "principled" shaders (README.md of render
/// says which is which). Three kinds of surface are mixed: metal, glass and a diffuse body under a clear
/// coat. The default is plain diffuse. Both sides are alike, except that glass is inside where triangles are
/// seen from behind.
struct Material {
    Color base_color{0.7f, 0.7f, 0.7f};  ///< in [0, 1]: albedo of the body, reflectance of metal at normal
                                         ///< incidence, tint of what passes through glass and out again
    float metallic = 0.0f;               ///< share of metal, in [0, 1]
    float transmission = 0.0f;           ///< share of glass in what is not metal, in [0, 1]
    float roughness = 0.5f;  ///< of metal, glass and coat, in [0, 1]; alpha of GGX is its square. Below
                             ///< 0.03 metal and coat are taken as 0.03, glass as perfectly smooth
    float specular = 0.0f;   ///< weight of the coat's reflection, in [0, 1]; 0: diffuse, 1: plastic
    float ior = 1.5f;        ///< refractive index of glass and coat, >= 1
    Color edge_color{1.0f, 1.0f,
                     1.0f};            ///< reflectance of metal at grazing incidence (Schlick's Fresnel term)
    Color emission{0.0f, 0.0f, 0.0f};  ///< radiance; found by camera and scattered rays only: for large faint
                                       ///< sources. Small bright ones belong in a light.
    float wire_width =
        0.0f;  ///< pixels of the picture; above 0, the edges of the triangles are drawn so wide
    Color wire_color{0.02f, 0.02f, 0.02f};  ///< albedo of the drawn edges
    /// Seen by the camera, the surface is diffuse with the albedo with which it would have the background's
    /// radiance if nothing stood on it: a ground that shows shadows only and has no horizon. The surface must
    /// be flat. To other rays it is what the parameters above say.
    bool shadow_catcher = false;
};

}  // namespace automorph::render
