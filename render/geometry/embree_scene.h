#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "render/geometry/triangle_mesh.h"
#include "render/math/ray.h"

namespace automorph::render {

/// The first triangle along a ray.
struct Hit {
    float
        distance;  ///< in lengths of the direction; Embree's, good for comparing, not for computing the point
    std::uint32_t mesh, triangle;
};

/// Whether Embree can trace a ray: it ends the program where a coordinate is not finite or beyond some 1e18.
inline bool traceable(const Ray& ray) {
    constexpr float kLargest = 1e18f;
    return ray.origin.cwiseAbs().sum() + ray.direction.cwiseAbs().sum() < kLargest;
}

/// Rays that are traced together.
struct RayPacket {
    static constexpr std::size_t kSize = 16;
    std::array<Ray, kSize> rays;
    std::size_t count = 0;  ///< of rays that are set, at least 1
};

struct CommitOptions {
    bool refit = false;  ///< makes a tree that keeps its order when vertices move, if it is not the first
};

/// The door to Embree (3 and 4): only its source includes Embree's headers.
class EmbreeScene {
public:
    /// @param config  for the device, e.g. "isa=sse4.2"
    /// @throws ConfigError if the config names an instruction set that does not exist
    /// @throws Error with Embree's message
    explicit EmbreeScene(const std::string& config);
    ~EmbreeScene();

    /// Sets mesh number `id`, whose arrays must stay where they are while this object lives.
    /// @throws Error with Embree's message, e.g. if the number is taken
    void attach(std::uint32_t id, const TriangleMesh& mesh);

    /// Says that the vertices of mesh `id` have moved.
    void moved(std::uint32_t id);

    /// Builds or refits the tree if anything changed, with the threads of the calling TBB arena.
    void commit(const CommitOptions& options = {});

    /// First hit in (0, far). @pre traceable(ray)
    std::optional<Hit> intersect(const Ray& ray, float far) const;

    /// First hits of a packet; rays that cannot be traced have none. For rays of one pixel this takes a third
    /// of the time of single rays.
    std::array<std::optional<Hit>, RayPacket::kSize> intersect(const RayPacket& packet) const;

    /// Whether anything lies in (0, far). The direction may have any length. @pre traceable(ray)
    bool occluded(const Ray& ray, float far) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace automorph::render
