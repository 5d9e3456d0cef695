#pragma once

#include <algorithm>
#include <cmath>

#include "render/math/disk.h"
#include "render/math/vec.h"

namespace automorph::render {

/// Isotropic GGX (Trowbridge-Reitz) distribution of microfacet normals with Smith's masking [Walter07].
/// Directions are unit vectors in the local shading frame, normals h have h.z > 0.
struct Ggx {
    float alpha;  ///< > 0

    /// Density of microfacet normals per area of the surface: the integral of D h.z is one.
    float D(const Vec3& h) const {
        const float a2 = alpha * alpha;
        const float t = (h.x() * h.x() + h.y() * h.y()) / a2 + h.z() * h.z();
        return 1.0f / (kPi * a2 * t * t);
    }

    /// Share of the microfacets that `w` sees unmasked. Masking and shadowing are taken as independent, G =
    /// G1(o) G1(i).
    float G1(const Vec3& w) const {
        const float z2 = w.z() * w.z();
        const float tan2 = (w.x() * w.x() + w.y() * w.y()) / z2;
        return z2 > 0.0f ? 2.0f / (1.0f + std::sqrt(1.0f + alpha * alpha * tan2)) : 0.0f;
    }

    /// A normal from those that `wo` sees, with the density of visible() [Heitz18]. @pre wo.z > 0
    Vec3 sample(const Vec3& wo, float u, float v) const {
        Vec3 stretched(alpha * wo.x(), alpha * wo.y(), wo.z());
        stretched /= std::sqrt(stretched.squaredNorm());
        const float length2 = stretched.x() * stretched.x() + stretched.y() * stretched.y();
        const Vec3 t1 = length2 > 1e-14f
                            ? Vec3(Vec3(-stretched.y(), stretched.x(), 0.0f) / std::sqrt(length2))
                            : Vec3(1.0f, 0.0f, 0.0f);
        const Vec3 t2 = cross(stretched, t1);
        const Eigen::Vector2f disk = sample_disk(u, v);
        const float s = 0.5f * (1.0f + stretched.z());
        const float p1 = disk.x();
        const float p2 = (1.0f - s) * std::sqrt(std::max(0.0f, 1.0f - p1 * p1)) + s * disk.y();
        const float p3 = std::sqrt(std::max(0.0f, 1.0f - p1 * p1 - p2 * p2));
        const Vec3 n = p1 * t1 + p2 * t2 + p3 * stretched;
        const Vec3 h(alpha * n.x(), alpha * n.y(), std::max(1e-6f, n.z()));
        return h / std::sqrt(h.squaredNorm());
    }

    /// Density of the directions mirrored at sample(), per solid angle; h is halfway between them and wo.
    float reflected_pdf(const Vec3& wo, const Vec3& h) const { return G1(wo) * D(h) / (4.0f * wo.z()); }

    /// Density of sample() per solid angle of h.
    float visible(const Vec3& wo, const Vec3& h) const {
        return G1(wo) * std::max(0.0f, wo.dot(h)) * D(h) / wo.z();
    }
};

/// Share of unpolarised light that a smooth boundary of two dielectrics reflects. One for total reflection.
/// @param cosine  of the angle of incidence, in [0, 1]
/// @param eta     refractive index beyond the boundary over that before it
inline float fresnel(float cosine, float eta) {
    const float sine2 = std::max(0.0f, 1.0f - cosine * cosine) / (eta * eta);  // of the refracted ray
    if (sine2 >= 1.0f) return 1.0f;
    const float refracted = std::sqrt(1.0f - sine2);
    const float parallel = (eta * cosine - refracted) / (eta * cosine + refracted);
    const float perpendicular = (cosine - eta * refracted) / (cosine + eta * refracted);
    return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

/// Schlick's approximation: from `normal` at normal incidence to `edge` at grazing incidence.
inline Color schlick(float cosine, const Color& normal, const Color& edge) {
    const float m = 1.0f - cosine, m2 = m * m;
    return normal + m2 * m2 * m * (edge - normal);
}

}  // namespace automorph::render
