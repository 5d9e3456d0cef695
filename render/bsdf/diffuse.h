#pragma once

#include <algorithm>
#include <cmath>

#include "render/math/disk.h"
#include "render/math/vec.h"

namespace automorph::render {

/// A direction sampled by a BSDF, in the local shading frame (z along the normal).
struct BsdfSample {
    Vec3 wi;               ///< unit, towards the light
    Color weight;          ///< f cos / pdf
    float pdf;             ///< per solid angle; infinite if the direction is the only one
    float density = 1.0f;  ///< square of the refractive index crossed: what refraction took from `weight` by
                           ///< spreading light and gives back on leaving
};

/// Lambertian reflection f = albedo / pi on the side z > 0. All directions are unit vectors in the local
/// shading frame; densities are per solid angle.
class Diffuse {
public:
    explicit Diffuse(const Color& albedo) : albedo_(albedo) {}

    /// f cos for light from `wi`.
    Color evaluate(const Vec3& wi) const { return pdf(wi) * albedo_; }

    /// Density with which sample() takes `wi`.
    float pdf(const Vec3& wi) const { return wi.z() > 0.0f ? wi.z() * kInvPi : 0.0f; }

    /// A direction proportional to the cosine, for (u, v) in [0, 1)^2 (Malley's method).
    BsdfSample sample(float u, float v) const {
        const Eigen::Vector2f disk = sample_disk(u, v);
        const float z2 = std::max(0.0f, 1.0f - disk.squaredNorm());
        const float z = std::max(kLowest, std::sqrt(z2));
        return {{disk.x(), disk.y(), z}, albedo_, z * kInvPi};
    }

private:
    static constexpr float kLowest = 1e-6f;  // above the horizon, so that pdf and weight are never 0/0

    Color albedo_;
};

}  // namespace automorph::render
