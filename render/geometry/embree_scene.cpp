#include "render/geometry/embree_scene.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <mutex>
#include <vector>

#include "morph/mesh/errors.h"

namespace automorph::render {
namespace {

// Embree ignores what it does not know, and a mistyped instruction set would pin nothing.
void check_config(const std::string& config) {
    constexpr std::array kSets = {"sse2", "sse4.2", "avx", "avx2", "avx512"};
    const std::string key = "isa=";
    const std::size_t start = config.find(key);
    if (start == std::string::npos) return;
    const std::size_t value = start + key.size();
    const std::string set = config.substr(value, config.find_first_of(", ", value) - value);
    if (std::find(kSets.begin(), kSets.end(), set) == kSets.end()) {
        throw ConfigError(
            fmt::format("Embree config \"{}\": there is no instruction set \"{}\"; allowed are {}", config,
                        set, fmt::join(kSets, ", ")));
    }
}

const char* name(RTCError code) {
    switch (code) {
        case RTC_ERROR_NONE:
            return "no error";
        case RTC_ERROR_INVALID_ARGUMENT:
            return "invalid argument";
        case RTC_ERROR_INVALID_OPERATION:
            return "invalid operation";
        case RTC_ERROR_OUT_OF_MEMORY:
            return "out of memory";
        case RTC_ERROR_UNSUPPORTED_CPU:
            return "this processor is not supported";
        case RTC_ERROR_CANCELLED:
            return "cancelled";
        default:
            return "unknown error";
    }
}

RTCRay make_ray(const Ray& from, float far) {
    RTCRay ray;
    ray.org_x = from.origin.x();
    ray.org_y = from.origin.y();
    ray.org_z = from.origin.z();
    ray.tnear = 0.0f;
    ray.dir_x = from.direction.x();
    ray.dir_y = from.direction.y();
    ray.dir_z = from.direction.z();
    ray.time = from.time;
    ray.tfar = far;
    ray.mask = ~0u;
    ray.id = 0;
    ray.flags = 0;
    return ray;
}

// The one place where the query calls of Embree 3 and 4 differ.
#if RTC_VERSION_MAJOR >= 4
void trace(RTCScene scene, RTCRayHit& ray) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_INCOHERENT;
    arguments.feature_mask = RTC_FEATURE_FLAG_TRIANGLE;
    rtcIntersect1(scene, &ray, &arguments);
}

void trace(RTCScene scene, const int* valid, RTCRayHit16& rays) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    arguments.feature_mask = RTC_FEATURE_FLAG_TRIANGLE;
    rtcIntersect16(valid, scene, &rays, &arguments);
}

void trace_shadow(RTCScene scene, RTCRay& ray) {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.feature_mask = RTC_FEATURE_FLAG_TRIANGLE;
    rtcOccluded1(scene, &ray, &arguments);
}
#else
void trace(RTCScene scene, RTCRayHit& ray) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    rtcIntersect1(scene, &context, &ray);
}

void trace(RTCScene scene, const int* valid, RTCRayHit16& rays) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid, scene, &context, &rays);
}

void trace_shadow(RTCScene scene, RTCRay& ray) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
}
#endif

}  // namespace

struct EmbreeScene::State {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::vector<RTCGeometry> geometries;  // by mesh number, null without triangles; owned by the scene
    std::vector<unsigned> time_steps;     // by mesh number
    std::mutex mutex;                     // builds report errors from any thread
    std::string error;                    // the first one since the last check
    bool refit = false;                   // whether the tree is one that can be refitted
    bool changed = true;

    void prepare(bool refits);

    ~State() {
        if (scene != nullptr) rtcReleaseScene(scene);
        if (device != nullptr) rtcReleaseDevice(device);
    }

    void check(const char* what) {
        if (error.empty()) return;
        const std::string message = fmt::format("Embree failed to {}: {}", what, error);
        error.clear();
        throw Error(message);
    }
};

EmbreeScene::EmbreeScene(const std::string& config) : state_(std::make_unique<State>()) {
    check_config(config);
    State& state = *state_;
    state.device = rtcNewDevice(config.c_str());
    if (state.device == nullptr) {
        throw Error(fmt::format("Embree cannot make a device with config \"{}\": {}", config,
                                name(rtcGetDeviceError(nullptr))));
    }
    rtcSetDeviceErrorFunction(
        state.device,
        [](void* user, RTCError code, const char* text) {
            State& self = *static_cast<State*>(user);
            const std::lock_guard lock(self.mutex);
            if (self.error.empty())
                self.error = fmt::format("{} ({})", text != nullptr ? text : "", name(code));
        },
        &state);
    state.scene = rtcNewScene(state.device);
    state.check("make a scene");
}

EmbreeScene::~EmbreeScene() = default;

void EmbreeScene::attach(std::uint32_t id, const TriangleMesh& mesh) {
    State& state = *state_;
    state.changed = true;
    if (state.geometries.size() <= id) {
        state.geometries.resize(id + 1, nullptr);
        state.time_steps.resize(id + 1, 1);
    }
    state.time_steps[id] = static_cast<unsigned>(mesh.time_steps());
    if (mesh.triangle_count() == 0) return;
    RTCGeometry geometry = rtcNewGeometry(state.device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryTimeStepCount(geometry, static_cast<unsigned>(mesh.time_steps()));
    for (int step = 0; step < mesh.time_steps(); ++step) {
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, static_cast<unsigned>(step),
                                   RTC_FORMAT_FLOAT3, mesh.positions(step), 0, 3 * sizeof(float),
                                   static_cast<std::size_t>(mesh.vertex_count()));
    }
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.indices(), 0,
                               3 * sizeof(std::uint32_t), static_cast<std::size_t>(mesh.triangle_count()));
    if (state.refit) rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_REFIT);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(state.scene, geometry, id);
    rtcReleaseGeometry(geometry);
    state.geometries[id] = geometry;
    state.check("add a mesh");
}

void EmbreeScene::moved(std::uint32_t id) {
    State& state = *state_;
    state.changed = true;
    RTCGeometry geometry = state.geometries[id];
    if (geometry == nullptr) return;
    for (unsigned step = 0; step < state.time_steps[id]; ++step)
        rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, step);
    rtcCommitGeometry(geometry);
    state.check("move a mesh");
}

// Sets which kind of tree the next commit makes.
void EmbreeScene::State::prepare(bool refits) {
    if (refits == refit) return;
    refit = refits;
    // Only trees of low quality have one level per mesh, which is what is refitted.
    rtcSetSceneFlags(scene, refits ? RTC_SCENE_FLAG_DYNAMIC : RTC_SCENE_FLAG_NONE);
    rtcSetSceneBuildQuality(scene, refits ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_MEDIUM);
    for (RTCGeometry geometry : geometries) {
        if (geometry == nullptr) continue;
        rtcSetGeometryBuildQuality(geometry, refits ? RTC_BUILD_QUALITY_REFIT : RTC_BUILD_QUALITY_MEDIUM);
        rtcCommitGeometry(geometry);
    }
}

void EmbreeScene::commit(const CommitOptions& options) {
    State& state = *state_;
    if (!state.changed) return;
    state.prepare(options.refit);
    rtcCommitScene(state.scene);
    state.check("build the tree");
    state.changed = false;
}

std::optional<Hit> EmbreeScene::intersect(const Ray& ray, float far) const {
    RTCRayHit query;
    query.ray = make_ray(ray, far);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    trace(state_->scene, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return Hit{query.ray.tfar, query.hit.geomID, query.hit.primID};
}

std::array<std::optional<Hit>, RayPacket::kSize> EmbreeScene::intersect(const RayPacket& packet) const {
    alignas(64) std::array<int, RayPacket::kSize> valid;
    alignas(64) RTCRayHit16 query;
    // Where Embree splits a packet (without AVX-512), it looks at the rays of a part even if none is valid.
    const Ray unused{Vec3::Zero(), Vec3::UnitX()};
    for (std::size_t i = 0; i < RayPacket::kSize; ++i) {
        const bool used = i < packet.count && traceable(packet.rays[i]);
        valid[i] = used ? -1 : 0;
        const Ray& ray = used ? packet.rays[i] : unused;
        query.ray.org_x[i] = ray.origin.x();
        query.ray.org_y[i] = ray.origin.y();
        query.ray.org_z[i] = ray.origin.z();
        query.ray.tnear[i] = 0.0f;
        query.ray.dir_x[i] = ray.direction.x();
        query.ray.dir_y[i] = ray.direction.y();
        query.ray.dir_z[i] = ray.direction.z();
        query.ray.time[i] = ray.time;
        query.ray.tfar[i] = std::numeric_limits<float>::infinity();
        query.ray.mask[i] = ~0u;
        query.ray.id[i] = 0;
        query.ray.flags[i] = 0;
        query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    trace(state_->scene, valid.data(), query);
    std::array<std::optional<Hit>, RayPacket::kSize> hits;
    for (std::size_t i = 0; i < packet.count; ++i) {
        if (query.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID)
            hits[i] = Hit{query.ray.tfar[i], query.hit.geomID[i], query.hit.primID[i]};
    }
    return hits;
}

bool EmbreeScene::occluded(const Ray& ray, float far) const {
    RTCRay query = make_ray(ray, far);
    trace_shadow(state_->scene, query);
    return query.tfar < 0.0f;
}

}  // namespace automorph::render
