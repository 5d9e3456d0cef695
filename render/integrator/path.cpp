#include "render/integrator/path.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace automorph::render {
namespace {

// A sample that cannot be taken, since a ray of it is not finite; it will be dropped and counted.
const Color kBad = Color::Constant(std::numeric_limits<float>::quiet_NaN());

constexpr float kLeastEyeCosine = 0.02f;  // between shading normal and eye, where a surface is not diffuse

// Power heuristic with exponent 2 for the strategy of density a [Veach95]; written so that nothing overflows.
float mis_weight(float a, float b) {
    const float ratio = b / a;
    return 1.0f / (1.0f + ratio * ratio);
}

// Interpolated normals can face away from the eye, where glossy surfaces would be black: bent towards it.
Vec3 towards(const Vec3& normal, const Vec3& eye) {
    const float cosine = normal.dot(eye);
    if (cosine >= kLeastEyeCosine) return normal;
    return (normal + (kLeastEyeCosine - cosine) * eye).normalized();
}

}  // namespace

// A scattering vertex: where it is, and its BSDF in the local shading frame.
struct PathTracer::Vertex {
    SurfacePoint surface;
    const PreparedMaterial& material;
    Frame frame;
    Bsdf bsdf;

    Vertex(const PathTracer& tracer, const Ray& ray, const Hit& hit, int depth, bool through_glass)
        : surface(surface_point(tracer.scene_, hit, ray)),
          material(tracer.materials_[hit.mesh]),
          frame(material.diffuse ? surface.shading_normal : towards(surface.shading_normal, -ray.direction)),
          bsdf(material, surface.base_color,
               material.diffuse ? Vec3(0, 0, 1) : frame.to_local(-ray.direction), surface.front) {
        if (through_glass && material.material.shadow_catcher)
            bsdf = Bsdf::diffuse(tracer.catcher_albedo(hit.mesh, surface));
        if (depth == 0 && material.material.wire_width > 0.0f && tracer.on_wire(ray, hit, surface)) {
            surface.base_color = material.material.wire_color;
            bsdf = Bsdf::diffuse(surface.base_color);
        }
    }
};

// A path between two surfaces.
struct PathTracer::Flight {
    Ray ray;
    Color throughput = Color::Ones();
    Vec3 normal = Vec3::Zero();  // where the ray starts
    float bsdf_pdf = 0.0f;       // of the ray's direction
    float density = 1.0f;        // of the medium, squared index: what refraction took from the throughput
    bool through_glass = true;   // what is met now is seen directly, or through nothing but glass
};

// One of the paths that share a first surface.
struct PathTracer::Branch {
    std::uint32_t number, of;
};

PathTracer::PathTracer(const Scene& scene, const PictureCamera& camera, const RenderOptions& options)
    : scene_(scene),
      options_(options),
      view_(camera.forward()),
      pixel_size_(camera.pixel_size()),
      lights_(scene.lights, scene.sphere_lights, scene.sky),
      background_(scene.background.value_or(Color::Zero())),
      map_is_sampled_(scene.sky.map && scene.sky.map->power() > 0.0f) {
    bool choices = lights_.size() > 1;
    for (int i = 0; i < scene.mesh_count(); ++i) {
        materials_.emplace_back(scene.material(i));
        choices = choices || !materials_.back().diffuse;
        catcher_sky_.emplace_back();
        if (!scene.material(i).shadow_catcher || scene.mesh(i).triangle_count() == 0) continue;
        const Vec3 normal = geometric_normal(scene.mesh(i), 0);
        catcher_sky_.back() = {irradiance(scene.sky, normal), irradiance(scene.sky, -normal)};
    }
    usual_pairs_ = choices ? kChoice + 1 : kScatter + 1;
}

// How much of the light that a ray finds is counted: the rest comes from direct_light() at the ray's origin.
float PathTracer::found_weight(int depth, float bsdf_pdf, float light_pdf) const {
    if (depth == 0 || std::isinf(bsdf_pdf) || options_.lights == LightStrategy::Scatter) return 1.0f;
    return options_.lights == LightStrategy::Lights ? 0.0f : mis_weight(bsdf_pdf, light_pdf);
}

// Light of rectangles and spheres between the ray's origin and `far`.
Color PathTracer::light_on_the_way(const Ray& ray, const Vec3& normal, float far, int depth,
                                   float bsdf_pdf) const {
    return lights_.met({ray.origin, normal}, ray.direction, far, [&](const auto& light, float light_pdf) {
        if (depth == 0 && !light.visible_to_camera) return 0.0f;
        return found_weight(depth, bsdf_pdf, light_pdf);
    });
}

Color PathTracer::sky(const Ray& ray, const Vec3& normal, int depth, bool through_glass,
                      float bsdf_pdf) const {
    // A map is sampled from inside rough glass too: there the background would count twice.
    if (scene_.background && (depth == 0 || (through_glass && !map_is_sampled_))) return background_;
    const Color smooth = scene_.sky.smooth(ray.direction);
    if (!map_is_sampled_) return smooth;
    const float weight =
        depth == 0 || std::isinf(bsdf_pdf)
            ? 1.0f
            : found_weight(depth, bsdf_pdf, lights_.map_pdf({ray.origin, normal}, ray.direction));
    return smooth + weight * (*scene_.sky.map)(ray.direction);
}

// Reflected light of one light, chosen and sampled.
Color PathTracer::direct_light(const Vertex& vertex, float choice, Sample2 place, float time,
                               std::uint64_t& rays) const {
    const Vec3& from = vertex.surface.ray_origin;
    const std::optional<LightSample> light =
        lights_.sample({from, vertex.frame.normal}, choice, place.u, place.v);
    if (!light) return Color::Zero();
    const Vec3 wi = vertex.frame.to_local(light->wi);
    const BsdfValue value = vertex.bsdf.evaluate(wi);
    if (!(value.pdf > 0.0f)) return Color::Zero();
    ++rays;
    const Ray shadow{wi.z() > 0.0f ? from : vertex.surface.ray_origin_behind, light->to_light, time};
    if (!traceable(shadow)) return kBad;
    if (scene_.embree().occluded(shadow, light->far)) return Color::Zero();
    const float weight = options_.lights == LightStrategy::Lights ? 1.0f : mis_weight(light->pdf, value.pdf);
    return weight / light->pdf * value.f_cos * light->radiance;
}

// Whether a camera ray met a drawn edge of a triangle.
bool PathTracer::on_wire(const Ray& ray, const Hit& hit, const SurfacePoint& surface) const {
    const float depth = (surface.position - ray.origin).dot(view_);
    const float distance =
        edge_distance(scene_.mesh(static_cast<int>(hit.mesh)), hit.triangle, surface.position, ray);
    return distance < 0.5f * materials_[hit.mesh].material.wire_width * pixel_size_ * depth;
}

// The albedo with which an unshadowed ground has exactly the background's radiance.
Color PathTracer::catcher_albedo(std::uint32_t mesh, const SurfacePoint& surface) const {
    const Color background = scene_.background ? background_ : scene_.sky.radiance;
    const CatcherSky& sky = catcher_sky_[mesh];
    const Color sum =
        (surface.front ? sky.front : sky.back) + lights_.irradiance(surface.position, surface.shading_normal);
    return (sum > 0.0f).select(kPi * background / sum, 0.0f);
}

// Goes on in the sampled direction; false where the path ends.
bool PathTracer::scatter(const Vertex& vertex, int depth, Sample2 uv, float choice, Flight& flight) const {
    const std::optional<BsdfSample> scattered = vertex.bsdf.sample(uv.u, uv.v, choice);
    if (!scattered) return false;
    flight.throughput *= scattered->weight;
    flight.density *= scattered->density;
    if (depth >= options_.roulette_after) {
        const float survival = std::min(1.0f, flight.density * flight.throughput.maxCoeff());
        if (!(choice < survival)) return false;
        flight.throughput /= survival;
    }
    flight.bsdf_pdf = scattered->pdf;
    flight.normal = vertex.frame.normal;
    flight.ray.direction = vertex.frame.to_world(scattered->wi);
    if (scattered->wi.z() > 0.0f) {
        flight.through_glass = false;
        flight.ray.origin = vertex.surface.ray_origin;
        return true;
    }
    flight.ray.origin = vertex.surface.ray_origin_behind;
    // Refracted by the interpolated normal, but reflected by the true one: there is no such light.
    return !(flight.ray.direction.dot(vertex.surface.geometric_normal) > 0.0f);
}

// All that a path brings from where it left the first surface.
Color PathTracer::follow(Flight flight, const SampleNumbers& random, Branch branch,
                         std::uint64_t& rays) const {
    Color sum = Color::Zero();
    for (int depth = 1;; ++depth) {
        const Ray& ray = flight.ray;
        if (!traceable(ray)) return kBad;
        ++rays;
        const std::optional<Hit> hit = scene_.embree().intersect(ray, kInfinity);
        sum += flight.throughput *
               light_on_the_way(ray, flight.normal, hit ? hit->distance : kInfinity, depth, flight.bsdf_pdf);
        if (!hit) {
            return sum +
                   flight.throughput * sky(ray, flight.normal, depth, flight.through_glass, flight.bsdf_pdf);
        }
        sum += flight.throughput * materials_[hit->mesh].material.emission;
        if (depth == options_.max_scatter) return sum;

        const Vertex v(*this, ray, *hit, depth, flight.through_glass);
        const auto pair = [&](Pair which) {
            return random.branch(static_cast<std::uint32_t>(depth) * kPairsPerVertex + which, branch.number,
                                 branch.of);
        };
        const bool choose = depth >= options_.roulette_after || lights_.size() > 1 || v.bsdf.needs_choice();
        const Sample2 choice = choose ? pair(kChoice) : Sample2{0.0f, 0.0f};
        if (samples_lights())
            sum += flight.throughput * direct_light(v, choice.u, pair(kLight), ray.time, rays);
        if (!scatter(v, depth, pair(kScatter), choice.v, flight)) return sum;
    }
}

Radiance PathTracer::radiance(const Ray& ray, const std::optional<Hit>& hit, const SampleNumbers& random,
                              std::uint64_t& rays, FirstSurface* first) const {
    Radiance result;
    if (!traceable(ray)) return {.near = kBad};
    ++rays;
    const Flight start{.ray = ray};
    result.near = light_on_the_way(ray, start.normal, hit ? hit->distance : kInfinity, 0, 0.0f);
    if (!hit) {
        result.near += sky(ray, start.normal, 0, true, 0.0f);
        return result;
    }
    result.near += materials_[hit->mesh].material.emission;
    if (options_.max_scatter == 0) return result;

    const Vertex v(*this, ray, *hit, 0, true);
    if (first != nullptr)
        *first = {v.surface.base_color, v.surface.shading_normal, v.surface.geometric_normal};
    if (samples_lights()) {
        const float choice = lights_.size() > 1 ? random(kChoice).u : 0.0f;
        result.near += direct_light(v, choice, random(kLight), ray.time, rays);
    }
    const bool choose = options_.roulette_after <= 0 || v.bsdf.needs_choice();
    const std::uint64_t before = rays;
    const Branch all{0, branches(hit->mesh)};
    for (Branch each = all; each.number < all.of; ++each.number) {
        Flight flight = start;
        const float choice = choose ? random.branch(kChoice, each.number, all.of).v : 0.0f;
        if (scatter(v, 0, random.branch(kScatter, each.number, all.of), choice, flight))
            result.far += follow(flight, random, each, rays);
    }
    result.far /= static_cast<float>(all.of);
    result.far_rays = rays - before;
    return result;
}

}  // namespace automorph::render
