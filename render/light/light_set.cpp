#include "render/light/light_set.h"

#include <algorithm>
#include <cmath>

namespace automorph::render {

LightSet::LightSet(const std::vector<RectangleLight>& rectangles, const std::vector<SphereLight>& spheres,
                   const Sky& sky)
    : rectangles_(rectangles),
      shapes_(rectangles.begin(), rectangles.end()),
      spheres_(spheres),
      map_(sky.map && sky.map->power() > 0.0f ? sky.map.get() : nullptr),
      size_(rectangles.size() + spheres.size() + (map_ != nullptr ? 1 : 0)) {}

namespace {

// Share of a light's strength that is left where its centre is below the surface's horizon: a part of it may
// be above, and light may come through the surface.
constexpr float kLeastLightCosine = 0.1f;

float cosine_to(const Vec3& center, const LitPoint& point) {
    const Vec3 to_center = center - point.position;
    return std::max(kLeastLightCosine, to_center.dot(point.normal) / std::sqrt(to_center.squaredNorm()));
}

}  // namespace

// What a light could give a surface: a rough measure, but zero only where it gives nothing.
float LightSet::strength(std::size_t light, const LitPoint& point) const {
    if (light < rectangles_.size()) {
        const RectangleLight& r = rectangles_[light];
        const Vec3 area_normal = cross(r.edge_u, r.edge_v), away = point.position - r.center;
        const float facing = away.dot(area_normal);
        if (!(facing > 0.0f)) return 0.0f;
        // Near a large light the distance to its centre says nothing.
        const float distance2 =
            away.squaredNorm() + 0.25f * (r.edge_u.squaredNorm() + r.edge_v.squaredNorm());
        return r.radiance.mean() * facing / (distance2 * std::sqrt(distance2)) * cosine_to(r.center, point);
    }
    light -= rectangles_.size();
    if (light < spheres_.size()) {
        const SphereLight& s = spheres_[light];
        const float distance2 = (point.position - s.center).squaredNorm(), radius2 = s.radius * s.radius;
        return distance2 > radius2
                   ? s.radiance.mean() * kPi * radius2 / distance2 * cosine_to(s.center, point)
                   : 0.0f;
    }
    return 0.25f * map_->power();  // of an even sky a surface gets a quarter
}

float LightSet::strength_of_all(const LitPoint& point) const {
    float sum = 0.0f;
    for (std::size_t i = 0; i < size(); ++i) sum += strength(i, point);
    return sum;
}

float LightSet::shared_probability(std::size_t light, const LitPoint& point) const {
    const float sum = strength_of_all(point);
    return sum > 0.0f ? strength(light, point) / sum : 0.0f;
}

std::optional<LightSample> LightSet::sample_any(const LitPoint& point, float choice, float u, float v) const {
    std::size_t chosen = 0;
    float probability = 1.0f;
    if (size() > 1) {
        const float sum = strength_of_all(point);
        float rest = choice * sum, own = strength(0, point);
        while (chosen + 1 < size() && rest >= own) {
            rest -= own;
            own = strength(++chosen, point);
        }
        probability = own / sum;
        if (!(probability > 0.0f)) return std::nullopt;
    }
    std::optional<LightSample> result;
    if (chosen < rectangles_.size()) {
        result = render::sample(rectangles_[chosen], shapes_[chosen], point.position, u, v);
    } else if (chosen - rectangles_.size() < spheres_.size()) {
        result = render::sample(spheres_[chosen - rectangles_.size()], point.position, u, v);
    } else {
        result = map_->sample(u, v);
    }
    if (result) result->pdf *= probability;
    return result;
}

Color LightSet::irradiance(const Vec3& point, const Vec3& normal) const {
    Color sum = Color::Zero();
    for (const RectangleLight& light : rectangles_) sum += render::irradiance(light, point, normal);
    for (const SphereLight& light : spheres_) sum += render::irradiance(light, point, normal);
    return sum;
}

}  // namespace automorph::render
