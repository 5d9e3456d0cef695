#pragma once

#include "render/math/vec.h"

namespace automorph::render {

/// A direction sampled by a BSDF, in the local shading frame (z along the normal).
struct BsdfSample {
    Vec3 wi;       ///< unit, towards the light
    Color weight;  ///< f cos / pdf
    float pdf;     ///< per solid angle
};

/// Lambertian reflection f = albedo / pi on the side z > 0. All directions are unit vectors in the local
/// shading frame; densities are per solid angle.
class Diffuse {
public:
    explicit Diffuse(const Color& albedo) : albedo_(albedo) {}

    /// f cos for light from `wi`.
    Color evaluate(const Vec3& wi) const { return wi.z() > 0.0f ? Color(albedo_ * pdf(wi)) : Color::Zero(); }

    /// Density with which sample() takes `wi`.
    float pdf(const Vec3& wi) const { return wi.z() > 0.0f ? wi.z() * kInvPi : 0.0f; }

    /// A direction proportional to the cosine, for (u, v) in [0, 1)^2.
    BsdfSample sample(float u, float v) const;

private:
    Color albedo_;
};

/// A point of the unit disk for (u, v) in [0, 1)^2: area-preserving and continuous [Shirley97]. It uses no
/// function of the C library whose last bit depends on the machine.
Eigen::Vector2f sample_disk(float u, float v);

}  // namespace automorph::render
