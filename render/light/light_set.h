#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "render/light/light.h"
#include "render/light/rectangle_light.h"
#include "render/light/sky.h"
#include "render/light/sphere_light.h"
#include "render/math/vec.h"

namespace automorph::render {

/// A place that is lit.
struct LitPoint {
    Vec3 position;
    Vec3 normal;  ///< unit, of shading
};

/// All lights that are sampled: rectangles, spheres and the map of the sky. One of them is chosen at each lit
/// point, by the irradiance that it could give there.
class LightSet {
public:
    /// The lights must outlive this object.
    LightSet(const std::vector<RectangleLight>& rectangles, const std::vector<SphereLight>& spheres,
             const Sky& sky);

    std::size_t size() const { return size_; }

    /// A direction to a light, chosen by `choice`, sampled by (u, v), all in [0, 1). The density is that of
    /// choice and direction. Empty where the chosen light does not shine.
    std::optional<LightSample> sample(const LitPoint& point, float choice, float u, float v) const {
        // The usual case, worth a short cut.
        if (size_ == 1 && !rectangles_.empty())
            return render::sample(rectangles_.front(), shapes_.front(), point.position, u, v);
        return sample_any(point, choice, u, v);
    }

    /// Radiance of the rectangles and spheres that a ray meets before `far`, each times weight(light, density
    /// of sample() at the ray's origin). They block nothing, so all of them count.
    template <class Weight>
    Color met(const LitPoint& origin, const Vec3& direction, float far, const Weight& weight) const {
        Color sum = Color::Zero();
        std::size_t index = 0;
        const auto add = [&](const auto& light, const std::optional<LightHit>& hit) {
            if (hit && hit->distance < far)
                sum += weight(light, probability(index, origin) * hit->pdf) * light.radiance;
            ++index;
        };
        for (std::size_t i = 0; i < rectangles_.size(); ++i)
            add(rectangles_[i], intersect(rectangles_[i], shapes_[i], origin.position, direction));
        for (const SphereLight& light : spheres_) add(light, intersect(light, origin.position, direction));
        return sum;
    }

    /// Density of sample() at `point` for a direction in which the map of the sky is seen.
    float map_pdf(const LitPoint& point, const Vec3& direction) const {
        return probability(size() - 1, point) * map_->pdf(direction);
    }

    /// Irradiance of rectangles and spheres without anything between.
    Color irradiance(const Vec3& point, const Vec3& normal) const;

private:
    std::optional<LightSample> sample_any(const LitPoint& point, float choice, float u, float v) const;
    float strength(std::size_t light, const LitPoint& point) const;
    float probability(std::size_t light, const LitPoint& point) const {
        return size_ == 1 ? 1.0f : shared_probability(light, point);
    }
    float strength_of_all(const LitPoint& point) const;
    float shared_probability(std::size_t light, const LitPoint& point) const;

    const std::vector<RectangleLight>& rectangles_;
    std::vector<RectangleShape> shapes_;  ///< of the rectangles
    const std::vector<SphereLight>& spheres_;
    const EquirectangularMap* map_;  ///< null without one
    std::size_t size_;
};

}  // namespace automorph::render
