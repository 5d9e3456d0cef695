#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "render/geometry/triangle_mesh.h"
#include "render/math/vec.h"

namespace automorph::render {

/// The first triangle along a ray.
struct Hit {
    float
        distance;  ///< in lengths of the direction; Embree's, good for comparing, not for computing the point
    std::uint32_t mesh, triangle;
};

/// The door to Embree (3 and 4): only its source includes Embree's headers.
class EmbreeScene {
public:
    struct Options {
        std::string config;  ///< for the device, e.g. "isa=sse4.2"
        bool refit = false;  ///< refit the tree when vertices move
    };

    /// @throws Error with Embree's message
    explicit EmbreeScene(const Options& options);
    ~EmbreeScene();

    /// Sets mesh number `id`, whose arrays must stay where they are while this object lives.
    void attach(std::uint32_t id, const TriangleMesh& mesh);

    /// Says that the vertices of mesh `id` have moved.
    void moved(std::uint32_t id);

    /// Builds or refits the tree if anything changed, with the threads of the calling TBB arena.
    void commit();

    /// First hit in (0, far). `coherent` is a hint that neighbouring calls trace neighbouring rays.
    std::optional<Hit> intersect(const Vec3& origin, const Vec3& direction, float far, bool coherent) const;

    /// Whether anything lies in (0, far).
    bool occluded(const Vec3& origin, const Vec3& direction, float far) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace automorph::render
