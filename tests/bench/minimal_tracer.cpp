#include "tests/bench/minimal_tracer.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <xmmintrin.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <limits>

namespace automorph::bench {
namespace {

struct Vec {
    float x = 0.0f, y = 0.0f, z = 0.0f;
};
Vec operator+(Vec a, Vec b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vec operator-(Vec a, Vec b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vec operator*(float s, Vec a) {
    return {s * a.x, s * a.y, s * a.z};
}
float dot(Vec a, Vec b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vec cross(Vec a, Vec b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vec unit(Vec a) {
    return 1.0f / std::sqrt(dot(a, a)) * a;
}

constexpr float kPi = 3.14159265f;
constexpr float kOffset = 1e-4f;  // of ray origins, scene units

// Marsaglia's xorshift*, started by a hash.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_((seed + 1) * 0x9e3779b97f4a7c15ull | 1u) {
        for (int i = 0; i < 4; ++i) (*this)();
    }
    float operator()() {
        state_ ^= state_ >> 12;
        state_ ^= state_ << 25;
        state_ ^= state_ >> 27;
        return static_cast<float>(state_ * 0x2545f4914f6cdd1dull >> 40) * 0x1p-24f;
    }

private:
    std::uint64_t state_;
};

Vec cosine_direction(Vec n, float u, float v) {
    const Vec helper = std::abs(n.x) > 0.5f ? Vec{0.0f, 1.0f, 0.0f} : Vec{1.0f, 0.0f, 0.0f};
    const Vec s = unit(cross(helper, n)), t = cross(n, s);
    const float r = std::sqrt(u), angle = 2.0f * kPi * v;
    return r * std::cos(angle) * s + r * std::sin(angle) * t + std::sqrt(1.0f - u) * n;
}

RTCRay make_ray(Vec origin, Vec direction, float far) {
    RTCRay ray{};
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tfar = far;
    ray.mask = ~0u;
    return ray;
}

#if RTC_VERSION_MAJOR >= 4
void trace(RTCScene scene, RTCRayHit& ray) {
    rtcIntersect1(scene, &ray, nullptr);
}
void trace_shadow(RTCScene scene, RTCRay& ray) {
    rtcOccluded1(scene, &ray, nullptr);
}
#else
void trace(RTCScene scene, RTCRayHit& ray) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &ray);
}
void trace_shadow(RTCScene scene, RTCRay& ray) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
}
#endif

void attach(RTCDevice device, RTCScene scene, const std::vector<float>& vertices,
            const std::vector<std::uint32_t>& triangles) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* to = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12,
                                       vertices.size() / 3);
    std::copy(vertices.begin(), vertices.end(), static_cast<float*>(to));
    to = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12,
                                 triangles.size() / 3);
    std::copy(triangles.begin(), triangles.end(), static_cast<std::uint32_t*>(to));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
}

struct Light {
    Vec center, normal, u, v;

    explicit Light(const float (&c)[3]) : center{c[0], c[1], c[2]} {
        normal = unit(Vec{} - center);
        u = unit(cross({0.0f, 0.0f, 1.0f}, normal));
        v = cross(normal, u);
    }
    Vec point(float a, float b) const { return center + (a - 0.5f) * u + (b - 0.5f) * v; }
};

float radiance(RTCScene tree, const MinimalScene& scene, const Light& light, Vec o, Vec d, int max_scatter,
               Random& random, std::uint64_t& rays) {
    float throughput = 1.0f, sum = 0.0f;
    for (int depth = 0;; ++depth) {
        RTCRayHit hit;
        hit.ray = make_ray(o, d, std::numeric_limits<float>::infinity());
        hit.hit.geomID = hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        trace(tree, hit);
        ++rays;
        if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return sum + throughput * scene.sky;
        if (depth == max_scatter) return sum;
        Vec n = unit({hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z});
        if (dot(n, d) > 0.0f) n = -1.0f * n;
        o = o + hit.ray.tfar * d + kOffset * n;
        throughput *= hit.hit.geomID == 0 ? scene.mesh_albedo : scene.ground_albedo;

        const Vec to = light.point(random(), random()) - o;
        const float cosine = dot(to, n), cosine_light = -dot(to, light.normal), r2 = dot(to, to);
        if (cosine > 0.0f && cosine_light > 0.0f) {
            RTCRay shadow = make_ray(o, to, 1.0f - 1e-4f);
            trace_shadow(tree, shadow);
            ++rays;
            if (shadow.tfar >= 0.0f)
                sum += throughput * scene.light * cosine * cosine_light / (kPi * r2 * r2);
        }
        d = cosine_direction(n, random(), random());
    }
}

}  // namespace

MinimalResult minimal_trace(const MinimalScene& scene, int width, int height, int spp, int max_scatter) {
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene tree = rtcNewScene(device);
    attach(device, tree, scene.vertices, scene.triangles);
    attach(device, tree, scene.ground_vertices, scene.ground_triangles);
    rtcCommitScene(tree);

    const Vec eye{0.0f, -4.5f, 1.0f};
    const Light light(scene.light_center);
    const Vec forward = unit(Vec{0.0f, 0.0f, -0.1f} - eye), right = unit(cross(forward, {0.0f, 0.0f, 1.0f}));
    const Vec up = cross(right, forward);
    const float half = std::tan(15.0f * kPi / 180.0f);

    MinimalResult result;
    result.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const unsigned modes = _mm_getcsr();
    _mm_setcsr(modes | 0x8040);  // denormals are zero, as Embree wants it
    const std::clock_t start = std::clock();
    std::size_t next = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            Random random(next);
            double sum = 0.0;
            for (int s = 0; s < spp; ++s) {
                const float px = (2.0f * (static_cast<float>(x) + random()) - static_cast<float>(width)) /
                                 static_cast<float>(height);
                const float py =
                    1.0f - 2.0f * (static_cast<float>(y) + random()) / static_cast<float>(height);
                const Vec d = unit(forward + half * px * right + half * py * up);
                sum += static_cast<double>(
                    radiance(tree, scene, light, eye, d, max_scatter, random, result.rays));
            }
            result.pixels[next++] = static_cast<float>(sum / spp);
        }
    }
    result.cpu_seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    _mm_setcsr(modes);
    rtcReleaseScene(tree);
    rtcReleaseDevice(device);
    return result;
}

}  // namespace automorph::bench
