#pragma once

#include <array>
#include <optional>

#include "render/bsdf/diffuse.h"
#include "render/bsdf/material.h"
#include "render/bsdf/microfacet.h"
#include "render/math/vec.h"

namespace automorph::render {

/// Share of light that a coat reflects, by the cosine of the angle of incidence: what the body below does not
/// get.
struct CoatAlbedo {
    static constexpr int kSteps = 64;
    std::array<float, kSteps + 1> at{};  ///< at cosines 0, 1 / kSteps, ... 1
    float mean = 0.0f;                   ///< for even light from all sides

    float operator()(float cosine) const;
};

/// A material with what depends on it alone: computed once per picture, used at every vertex.
struct PreparedMaterial {
    /// @throws ConfigError naming the parameter that is out of range
    explicit PreparedMaterial(const Material& material);

    Material material;
    bool diffuse;       ///< nothing but diffuse
    bool smooth_glass;  ///< glass reflects and refracts into single directions
    Ggx ggx;            ///< of metal, glass and coat
    CoatAlbedo coat;    ///< zero without a coat
};

/// f cos and the density with which it is sampled.
struct BsdfValue {
    Color f_cos{0.0f, 0.0f, 0.0f};
    float pdf = 0.0f;  ///< per solid angle
};

/// How a place on a surface scatters light towards the direction `wo`. Directions are unit vectors in the
/// local shading frame, whose z axis is the normal on the side of `wo`; radiance is transported (so
/// refraction into a denser medium takes the factor 1 / eta^2).
class Bsdf {
public:
    /// @param base_color  of this place
    /// @param front       whether `wo` is on the front side of the triangle: outside of glass
    Bsdf(const PreparedMaterial& prepared, const Color& base_color, const Vec3& wo, bool front)
        : prepared_(&prepared), base_color_(base_color), wo_(wo), front_(front) {}

    /// A diffuse surface of this albedo, whatever its material.
    static Bsdf diffuse(const Color& albedo) { return {diffuse_material(), albedo, {0, 0, 1}, true}; }

    /// Light from `wi`, without single directions of smooth glass.
    BsdfValue evaluate(const Vec3& wi) const {
        if (!prepared_->diffuse) return evaluate_mixture(wi);
        const Diffuse body(base_color_);
        return {body.evaluate(wi), body.pdf(wi)};
    }

    /// Whether sample() looks at `choice`.
    bool needs_choice() const { return !prepared_->diffuse; }

    /// A direction for (u, v, choice) in [0, 1)^3; empty where the surface swallows the light. `choice`
    /// decides between kinds of surface and is stretched to be uniform in [0, 1) again.
    std::optional<BsdfSample> sample(float u, float v, float& choice) const {
        if (!prepared_->diffuse) return sample_mixture(u, v, choice);
        return Diffuse(base_color_).sample(u, v);
    }

    /// Mean reflectance, for pictures of the albedo.
    Color albedo() const { return base_color_; }

private:
    struct Shares;
    static const PreparedMaterial& diffuse_material();
    Shares shares() const;
    float eta() const { return front_ ? prepared_->material.ior : 1.0f / prepared_->material.ior; }
    BsdfValue metal(const Vec3& wi) const;
    BsdfValue body(const Vec3& wi, const Shares& shares) const;
    BsdfValue glass(const Vec3& wi) const;
    BsdfValue evaluate_mixture(const Vec3& wi) const;
    std::optional<BsdfSample> sample_mixture(float u, float v, float& choice) const;
    std::optional<BsdfSample> sample_smooth_glass(float& choice) const;
    std::optional<Vec3> sample_direction(const Shares& shares, float u, float v, float& choice) const;

    const PreparedMaterial* prepared_;
    Color base_color_;
    Vec3 wo_;
    bool front_;
};

}  // namespace automorph::render
