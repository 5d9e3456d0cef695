#include "render/bsdf/bsdf.h"

#include <fmt/format.h>

#include "morph/mesh/errors.h"

// Notation: wo towards the eye, wi towards the light, h the microfacet's normal, all with z along the
// surface's normal on the eye's side; eta = refractive index below over that above.

namespace automorph::render {
namespace {

constexpr float kLeastAlpha = 1e-3f;  // below, single precision does not resolve the highlight
constexpr float kLeastBending =
    1e-3f;  // of ior - 1: below, rough glass would have no microfacets to refract at
constexpr float kFirstCosine = 1e-3f;  // of the table's first entry, where zero would be no direction

void require(bool condition, const char* name, float value, const char* allowed) {
    if (!condition) throw ConfigError(fmt::format("material: {} is {}; it must be {}", name, value, allowed));
}

void check(const Material& m) {
    const auto share = [](const char* name, float x) {
        require(x >= 0.0f && x <= 1.0f, name, x, "in [0, 1]");
    };
    share("metallic", m.metallic);
    share("transmission", m.transmission);
    share("roughness", m.roughness);
    share("specular", m.specular);
    require(m.ior >= 1.0f && m.ior <= 10.0f, "ior", m.ior, "in [1, 10]");
}

// The share of light that a rough dielectric boundary reflects from direction (sin, 0, cos): the mean over
// its own samples, on a regular grid.
float reflected_share(const Ggx& ggx, float ior, float cosine) {
    constexpr int kGrid = 64;
    const Vec3 wo(std::sqrt(1.0f - cosine * cosine), 0.0f, cosine);
    float sum = 0.0f;
    for (int i = 0; i < kGrid; ++i) {
        for (int j = 0; j < kGrid; ++j) {
            const Vec3 h = ggx.sample(wo, (static_cast<float>(i) + 0.5f) / kGrid,
                                      (static_cast<float>(j) + 0.5f) / kGrid);
            const Vec3 wi = 2.0f * wo.dot(h) * h - wo;
            if (wi.z() > 0.0f) sum += fresnel(wo.dot(h), ior) * ggx.G1(wi);
        }
    }
    return sum / (kGrid * kGrid);
}

CoatAlbedo coat_albedo(const Ggx& ggx, float ior, float weight) {
    CoatAlbedo table;
    for (int i = 0; i <= CoatAlbedo::kSteps; ++i) {
        const float cosine = std::max(kFirstCosine, static_cast<float>(i) / CoatAlbedo::kSteps);
        table.at[static_cast<std::size_t>(i)] = weight * reflected_share(ggx, ior, std::min(1.0f, cosine));
    }
    // 2 times the integral of E(c) c over c, E linear in each step: Simpson's rule is exact.
    for (int i = 0; i < CoatAlbedo::kSteps; ++i) {
        const float a = table.at[static_cast<std::size_t>(i)], b = table.at[static_cast<std::size_t>(i + 1)];
        const float x = static_cast<float>(i), y = static_cast<float>(i + 1);
        table.mean += (a * x + (a + b) * (x + y) + b * y) / 3.0f;
    }
    table.mean /= static_cast<float>(CoatAlbedo::kSteps * CoatAlbedo::kSteps);
    return table;
}

// Decides with probability p; `choice` stays uniform.
bool decide(float p, float& choice) {
    if (choice < p) {
        choice = std::min(choice / p, 0x0.ffffffp0f);
        return true;
    }
    choice = p < 1.0f ? std::min((choice - p) / (1.0f - p), 0x0.ffffffp0f) : 0.0f;
    return false;
}

}  // namespace

float CoatAlbedo::operator()(float cosine) const {
    const float place = std::min(std::max(0.0f, cosine), 1.0f) * kSteps;
    const int cell = std::min(static_cast<int>(place), kSteps - 1);
    const float a = at[static_cast<std::size_t>(cell)], b = at[static_cast<std::size_t>(cell + 1)];
    return a + (place - static_cast<float>(cell)) * (b - a);
}

PreparedMaterial::PreparedMaterial(const Material& m) : material(m) {
    check(m);
    diffuse = m.metallic == 0.0f && m.transmission == 0.0f && m.specular == 0.0f;
    const float alpha = m.roughness * m.roughness;
    smooth_glass = alpha < kLeastAlpha || m.ior - 1.0f < kLeastBending;
    ggx.alpha = std::max(kLeastAlpha, alpha);
    if (m.specular > 0.0f && m.metallic < 1.0f && m.transmission < 1.0f)
        coat = coat_albedo(ggx, m.ior, m.specular);
}

/// How much of each kind of surface there is, and how often each is sampled.
struct Bsdf::Shares {
    float metal, glass, body;
    float coat;  ///< of the samples of the body, those of its coat
};

const PreparedMaterial& Bsdf::diffuse_material() {
    static const PreparedMaterial material{Material{}};
    return material;
}

Bsdf::Shares Bsdf::shares() const {
    const Material& m = prepared_->material;
    if (m.metallic == 1.0f) return {.metal = 1.0f, .glass = 0.0f, .body = 0.0f, .coat = 0.0f};
    Shares shares;
    shares.metal = m.metallic;
    shares.glass = (1.0f - m.metallic) * m.transmission;
    shares.body = 1.0f - shares.metal - shares.glass;
    const float reflected = prepared_->coat(wo_.z());
    const float below = std::max(0.0f, (1.0f - reflected) * base_color_.maxCoeff());  // 0 where not a number
    shares.coat = reflected > 0.0f ? reflected / (reflected + below) : 0.0f;
    return shares;
}

BsdfValue Bsdf::metal(const Vec3& wi) const {
    if (!(wi.z() > 0.0f)) return {};
    const Ggx& ggx = prepared_->ggx;
    const Vec3 h = (wo_ + wi).normalized();
    const float density = ggx.reflected_pdf(wo_, h);
    return {density * ggx.G1(wi) * schlick(wo_.dot(h), base_color_, prepared_->material.edge_color), density};
}

// The coat takes its share on the way in and on the way out; dividing by what is left on average makes the
// body reflect all the rest if it is white [Kelemen01].
BsdfValue Bsdf::body(const Vec3& wi, const Shares& shares) const {
    if (!(wi.z() > 0.0f)) return {};
    const Ggx& ggx = prepared_->ggx;
    const Diffuse diffuse(base_color_);
    const CoatAlbedo& coat = prepared_->coat;
    const float through = (1.0f - coat(wo_.z())) * (1.0f - coat(wi.z())) / (1.0f - coat.mean);
    BsdfValue value{through * diffuse.evaluate(wi), (1.0f - shares.coat) * diffuse.pdf(wi)};
    if (shares.coat > 0.0f) {
        const Vec3 h = (wo_ + wi).normalized();
        const float density = ggx.reflected_pdf(wo_, h);
        value.f_cos += prepared_->material.specular * fresnel(wo_.dot(h), prepared_->material.ior) * density *
                       ggx.G1(wi);
        value.pdf += shares.coat * density;
    }
    return value;
}

// [Walter07], eq. 20 and 21, with 1 / eta^2 for radiance.
BsdfValue Bsdf::glass(const Vec3& wi) const {
    if (prepared_->smooth_glass) return {};
    const Ggx& ggx = prepared_->ggx;
    if (wi.z() > 0.0f) {
        const Vec3 h = (wo_ + wi).normalized();
        const float reflected = fresnel(wo_.dot(h), eta());
        const float density = reflected * ggx.reflected_pdf(wo_, h);
        return {Color::Constant(density * ggx.G1(wi)), density};
    }
    if (!(wi.z() < 0.0f)) return {};
    Vec3 h = wo_ + eta() * wi;
    const float length2 = h.squaredNorm();
    if (!(length2 > 0.0f)) return {};  // the same medium on both sides: nothing is bent
    h *= (h.z() > 0.0f ? 1.0f : -1.0f) / std::sqrt(length2);
    const float cos_o = wo_.dot(h), cos_i = wi.dot(h);
    if (!(cos_o > 0.0f && cos_i < 0.0f)) return {};
    const float sum = cos_i + cos_o / eta();
    const float density = (1.0f - fresnel(cos_o, eta())) * ggx.visible(wo_, h) * -cos_i / (sum * sum);
    return {density * ggx.G1(wi) / (eta() * eta()) * base_color_.sqrt(), density};
}

BsdfValue Bsdf::evaluate_mixture(const Vec3& wi) const {
    const Shares share = shares();
    if (share.metal == 1.0f) return metal(wi);
    BsdfValue sum;
    const auto add = [&](float weight, const BsdfValue& value) {
        sum.f_cos += weight * value.f_cos;
        sum.pdf += weight * value.pdf;
    };
    if (share.metal > 0.0f) add(share.metal, metal(wi));
    if (share.glass > 0.0f) add(share.glass, glass(wi));
    if (share.body > 0.0f) add(share.body, body(wi, share));
    return sum;
}

std::optional<BsdfSample> Bsdf::sample_smooth_glass(float& choice) const {
    const float n = eta();
    if (decide(fresnel(wo_.z(), n), choice))
        return BsdfSample{{-wo_.x(), -wo_.y(), wo_.z()}, Color::Ones(), kInfinity};
    const float sine2 = std::max(0.0f, 1.0f - wo_.z() * wo_.z()) / (n * n);
    const Vec3 wi(-wo_.x() / n, -wo_.y() / n, -std::sqrt(std::max(0.0f, 1.0f - sine2)));
    return BsdfSample{wi, base_color_.sqrt() / (n * n), kInfinity, n * n};
}

// A direction by one of the kinds of surface. Empty where a microfacet sends the light back into the surface.
std::optional<Vec3> Bsdf::sample_direction(const Shares& shares, float u, float v, float& choice) const {
    const bool body = decide(shares.body, choice);
    if (body && !decide(shares.coat, choice)) return Diffuse(base_color_).sample(u, v).wi;
    const Vec3 h = prepared_->ggx.sample(wo_, u, v);
    const float cosine = wo_.dot(h);
    if (body || decide(shares.metal / (shares.metal + shares.glass), choice) ||
        decide(fresnel(cosine, eta()), choice)) {
        const Vec3 wi = 2.0f * cosine * h - wo_;
        return wi.z() > 0.0f ? std::optional(wi) : std::nullopt;
    }
    const float sine2 = std::max(0.0f, 1.0f - cosine * cosine) / (eta() * eta());
    const Vec3 wi = (cosine / eta() - std::sqrt(std::max(0.0f, 1.0f - sine2))) * h - wo_ / eta();
    return wi.z() < 0.0f ? std::optional(wi) : std::nullopt;
}

std::optional<BsdfSample> Bsdf::sample_mixture(float u, float v, float& choice) const {
    if (!(wo_.z() > 0.0f)) return std::nullopt;
    Shares share = shares();
    if (prepared_->smooth_glass && share.glass > 0.0f) {
        if (decide(share.glass, choice)) return sample_smooth_glass(choice);
        share.body /= 1.0f - share.glass;
        share.metal /= 1.0f - share.glass;
        share.glass = 0.0f;
    }
    const std::optional<Vec3> wi = sample_direction(share, u, v, choice);
    if (!wi) return std::nullopt;
    const BsdfValue value = evaluate_mixture(*wi);
    if (!(value.pdf > 0.0f)) return std::nullopt;
    return BsdfSample{*wi, value.f_cos / value.pdf, value.pdf, wi->z() < 0.0f ? eta() * eta() : 1.0f};
}

}  // namespace automorph::render
