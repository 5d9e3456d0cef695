#include "render/integrator/path.h"

#include <algorithm>
#include <limits>

#include "render/bsdf/diffuse.h"
#include "render/geometry/embree_scene.h"
#include "render/integrator/surface.h"

namespace automorph::render {
namespace {

// Pairs of random numbers: the place in the pixel, then per scattering vertex these.
enum Pair : std::uint32_t { kLight = 1, kScatter = 2, kChoice = 3, kPairsPerVertex = 3 };

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Power heuristic with exponent 2 for the strategy of density a [Veach95]; written so that nothing overflows.
float mis_weight(float a, float b) {
    const float ratio = b / a;
    return 1.0f / (1.0f + ratio * ratio);
}

}  // namespace

// A scattering vertex: where it is, and its BSDF in the local shading frame.
struct PathTracer::Vertex {
    SurfacePoint surface;
    Frame frame;
    Diffuse bsdf;
};

PathTracer::PathTracer(const Scene& scene, const RenderOptions& options)
    : scene_(scene), options_(options), background_(scene.background.value_or(scene.sky.radiance)) {
    float sum = 0.0f;
    for (const RectangleLight& light : scene.lights) {
        light_probability_.push_back(light.radiance.sum() * cross(light.edge_u, light.edge_v).norm());
        sum += light_probability_.back();
    }
    if (sum > 0.0f) {
        for (float& probability : light_probability_) probability /= sum;
    }
}

// Light of rectangles between the ray's origin and `far`. They block nothing, so all of them count.
Color PathTracer::light_on_the_way(const Vec3& origin, const Vec3& direction, float far, int depth,
                                   float bsdf_pdf) const {
    Color sum = Color::Zero();
    if (depth > 0 && options_.lights == LightStrategy::Lights) return sum;
    for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
        const RectangleLight& light = scene_.lights[i];
        const std::optional<LightHit> hit = intersect(light, origin, direction);
        if (!hit || hit->distance >= far) continue;
        if (depth == 0) {
            if (light.visible_to_camera) sum += light.radiance;
        } else if (options_.lights == LightStrategy::Scatter) {
            sum += light.radiance;
        } else {
            sum += mis_weight(bsdf_pdf, light_probability_[i] * hit->pdf) * light.radiance;
        }
    }
    return sum;
}

// Reflected light of one rectangle, chosen by power, sampled by area.
Color PathTracer::direct_light(const Vertex& vertex, Sample2 choice, Sample2 place,
                               std::uint64_t& rays) const {
    std::size_t chosen = 0;
    float rest = choice.u;
    while (chosen + 1 < light_probability_.size() && rest >= light_probability_[chosen]) {
        rest -= light_probability_[chosen++];
    }
    const float probability = light_probability_[chosen];
    if (!(probability > 0.0f)) return Color::Zero();

    const Vec3& from = vertex.surface.ray_origin;
    const std::optional<LightSample> light = sample(scene_.lights[chosen], from, place.u, place.v);
    if (!light) return Color::Zero();
    const Vec3 wi = vertex.frame.to_local(light->wi);
    if (!(wi.z() > 0.0f)) return Color::Zero();
    ++rays;
    if (scene_.embree().occluded(from, light->to_light, 1.0f)) return Color::Zero();
    const float pdf = probability * light->pdf;
    const float weight =
        options_.lights == LightStrategy::Lights ? 1.0f : mis_weight(pdf, vertex.bsdf.pdf(wi));
    return weight / pdf * vertex.bsdf.evaluate(wi) * light->radiance;
}

// The albedo with which an unshadowed ground has exactly the background's radiance.
Color PathTracer::catcher_albedo(const Vec3& position, const Vec3& normal) const {
    Color sum = kPi * scene_.sky.radiance;
    for (const RectangleLight& light : scene_.lights) sum += irradiance(light, position, normal);
    return (sum > 0.0f).select(kPi * background_ / sum, 0.0f);
}

Color PathTracer::radiance(Vec3 origin, Vec3 direction, std::optional<Hit> hit, const SampleNumbers& random,
                           std::uint64_t& rays) const {
    Color sum = Color::Zero();
    Color throughput = Color::Ones();
    float bsdf_pdf = 0.0f;  // of `direction`
    for (int depth = 0;; ++depth) {
        ++rays;
        if (depth > 0) hit = scene_.embree().intersect(origin, direction, kInfinity, false);
        sum += throughput *
               light_on_the_way(origin, direction, hit ? hit->distance : kInfinity, depth, bsdf_pdf);
        if (!hit) {
            sum += throughput * (depth == 0 ? background_ : scene_.sky(direction));
            break;
        }
        const SurfacePoint surface = surface_point(scene_, *hit, origin, direction);
        const Material& material = *surface.material;
        sum += throughput * material.emission;
        if (depth == options_.max_scatter) break;

        const bool catches = depth == 0 && material.shadow_catcher;
        const Vertex vertex{
            surface, Frame(surface.shading_normal),
            Diffuse(catches ? catcher_albedo(surface.position, surface.shading_normal) : material.albedo)};
        const auto pair = [&](Pair which) {
            return random(static_cast<std::uint32_t>(depth) * kPairsPerVertex + which);
        };
        const bool roulette = depth >= options_.roulette_after;
        const bool choose = light_probability_.size() > 1;
        const Sample2 choice = roulette || choose ? pair(kChoice) : Sample2{0.0f, 0.0f};
        if (!light_probability_.empty() && options_.lights != LightStrategy::Scatter) {
            sum += throughput * direct_light(vertex, choice, pair(kLight), rays);
        }

        const Sample2 uv = pair(kScatter);
        const BsdfSample scattered = vertex.bsdf.sample(uv.u, uv.v);
        throughput *= scattered.weight;
        if (roulette) {
            const float survival = std::min(1.0f, throughput.maxCoeff());
            if (!(choice.v < survival)) break;
            throughput /= survival;
        }
        bsdf_pdf = scattered.pdf;
        direction = vertex.frame.to_world(scattered.wi);
        origin = surface.ray_origin;
    }
    return sum;
}

}  // namespace automorph::render
