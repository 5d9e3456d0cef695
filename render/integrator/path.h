#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "render/bsdf/bsdf.h"
#include "render/geometry/embree_scene.h"
#include "render/geometry/scene.h"
#include "render/integrator/render.h"
#include "render/integrator/sample_numbers.h"
#include "render/integrator/surface.h"
#include "render/light/light_set.h"
#include "render/math/ray.h"
#include "render/math/vec.h"

namespace automorph::render {

/// What a camera ray meets first, or the sum over several.
struct FirstSurface {
    Color albedo = Color::Zero();
    Vec3 shading_normal = Vec3::Zero(), geometric_normal = Vec3::Zero();

    FirstSurface& operator+=(const FirstSurface& other) {
        albedo += other.albedo;
        shading_normal += other.shading_normal;
        geometric_normal += other.geometric_normal;
        return *this;
    }
};

/// What one camera ray finds.
struct Radiance {
    Color near = Color::Zero();  ///< emission and lights seen directly, and reflected light that was sampled
    Color far = Color::Zero();   ///< what the paths bring that go on from the first surface
    std::uint64_t far_rays = 0;  ///< that these took

    Color sum() const { return near + far; }
};

/// What all paths of a picture share.
class PathTracer {
public:
    /// @pre the scene is committed and stays unchanged while this object lives
    /// @throws ConfigError if a material is out of range
    PathTracer(const Scene& scene, const PictureCamera& camera, const RenderOptions& options);

    /// Lets so many paths go on from each mesh, by its number, where a camera ray meets it. One at first.
    void split(std::vector<std::uint32_t> branches) { branches_ = std::move(branches); }
    /// @pre the scene has this mesh
    std::uint32_t branches(std::uint32_t mesh) const { return branches_.empty() ? 1 : branches_[mesh]; }

    /// Radiance along a camera ray with known first hit: one sample of the path integral. Thread-safe.
    /// @param rays   counts the rays traced
    /// @param first  takes the first surface, if not null and if there is one
    Radiance radiance(const Ray& ray, const std::optional<Hit>& hit, const SampleNumbers& random,
                      std::uint64_t& rays, FirstSurface* first) const;

    /// How many of the first pairs of random numbers most paths take.
    std::uint32_t usual_pairs() const { return usual_pairs_; }

private:
    struct Vertex;
    struct Flight;
    struct Branch;
    bool on_wire(const Ray& ray, const Hit& hit, const SurfacePoint& surface) const;
    float found_weight(int depth, float bsdf_pdf, float light_pdf) const;
    Color light_on_the_way(const Ray& ray, const Vec3& normal, float far, int depth, float bsdf_pdf) const;
    Color sky(const Ray& ray, const Vec3& normal, int depth, bool through_glass, float bsdf_pdf) const;
    Color direct_light(const Vertex& vertex, float choice, Sample2 place, float time,
                       std::uint64_t& rays) const;
    bool samples_lights() const { return lights_.size() > 0 && options_.lights != LightStrategy::Scatter; }
    bool scatter(const Vertex& vertex, int depth, Sample2 uv, float choice, Flight& flight) const;
    Color follow(Flight flight, const SampleNumbers& random, Branch branch, std::uint64_t& rays) const;
    Color catcher_albedo(std::uint32_t mesh, const SurfacePoint& surface) const;

    struct CatcherSky {
        Color front = Color::Zero(), back = Color::Zero();  ///< irradiance
    };

    const Scene& scene_;
    const RenderOptions& options_;
    Vec3 view_;         ///< unit
    float pixel_size_;  ///< of a pixel at distance 1 along the view
    LightSet lights_;
    std::vector<PreparedMaterial> materials_;  ///< by mesh
    std::vector<CatcherSky> catcher_sky_;      ///< by mesh, of shadow catchers
    Color background_;
    bool map_is_sampled_;
    std::uint32_t usual_pairs_;
    std::vector<std::uint32_t> branches_;  ///< by mesh, or empty: one each
};

}  // namespace automorph::render
