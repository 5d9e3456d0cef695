#include "render/light/rectangle_light.h"

#include <cmath>
#include <random>

#include "tests/catch.h"

using namespace automorph::render;

namespace {

RectangleLight tilted() {
    RectangleLight light;
    light.center = {0.4f, -0.3f, 1.5f};
    light.edge_u = 1.2f * Vec3(0.8f, 0.0f, 0.6f);
    light.edge_v = cross(Vec3(0.0f, 0.0f, -1.0f), light.edge_u);
    light.edge_v *= 2.0f / light.edge_v.norm();
    light.radiance = {1.0f, 2.0f, 3.0f};
    return light;
}

struct Mean {
    double value, error;  // and its standard error
};

// Irradiance by sampling the light, without shadows.
Mean sampled_irradiance(const RectangleLight& light, const Vec3& point, const Vec3& normal, int samples) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform;
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < samples; ++i) {
        const float u = uniform(random), v = uniform(random);
        const auto s = sample(light, point, u, v);
        const double x = s ? std::max(0.0f, s->wi.dot(normal)) / s->pdf * s->radiance[0] : 0.0;
        sum += x;
        squares += x * x;
    }
    const double mean = sum / samples;
    return {mean, std::sqrt((squares / samples - mean * mean) / samples)};
}

}  // namespace

TEST_CASE("irradiance of a square light on axis has its closed form") {
    // A plane of albedo 1/2 has radiance 0.036739 under side 1 at height 2 and 0.277063 under side 2 at 1.
    const Vec3 origin(0, 0, 0), up(0, 0, 1);
    const RectangleLight far = square_light({0, 0, 2}, origin, 1.0f, Color::Ones());
    const RectangleLight near = square_light({0, 0, 1}, origin, 2.0f, Color::Ones());
    CHECK(irradiance(far, origin, up)[0] * 0.5f * kInvPi == Approx(0.036739f).epsilon(2e-5));
    CHECK(irradiance(near, origin, up)[0] * 0.5f * kInvPi == Approx(0.277063f).epsilon(2e-5));
}

TEST_CASE("irradiance agrees with sampling, also where the horizon cuts the light") {
    const RectangleLight light = tilted();
    for (const Vec3& normal :
         {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0.6f, -0.8f), Vec3(0.36f, 0.48f, 0.8f)}) {
        const Mean mean = sampled_irradiance(light, Vec3(0.1f, 0.2f, -0.1f), normal, 200000);
        const Color exact = irradiance(light, Vec3(0.1f, 0.2f, -0.1f), normal);
        CHECK(std::abs(exact[0] - mean.value) <= 4.0 * mean.error + 1e-6);
        CHECK(exact[2] == Approx(3.0f * exact[0]));
    }
    CHECK(irradiance(light, {0.1f, 0.2f, -0.1f}, {0.0f, 0.0f, -1.0f}).maxCoeff() == 0.0f);
}

TEST_CASE("the light is one-sided") {
    const RectangleLight light = square_light({0, 0, 2}, {0, 0, 0}, 1.0f, Color::Ones());
    CHECK_FALSE(sample(light, {0, 0, 3}, 0.3f, 0.3f).has_value());
    CHECK_FALSE(intersect(light, {0, 0, 3}, {0, 0, -1}).has_value());
    CHECK(irradiance(light, {0, 0, 3}, {0, 0, -1}).maxCoeff() == 0.0f);
    CHECK(sample(light, {0, 0, 1}, 0.3f, 0.3f).has_value());
}

TEST_CASE("the rays that meet the rectangle are those through its inside, at the right distance") {
    const RectangleLight light = tilted();
    const Vec3 origin(0.3f, 0.7f, -1.0f);
    for (float u : {-0.1f, 0.01f, 0.5f, 0.99f, 1.1f}) {
        for (float v : {-0.1f, 0.01f, 0.5f, 0.99f, 1.1f}) {
            const Vec3 to = light.center + (u - 0.5f) * light.edge_u + (v - 0.5f) * light.edge_v - origin;
            const auto hit = intersect(light, origin, to.normalized());
            const bool inside = u > 0 && u < 1 && v > 0 && v < 1;
            REQUIRE(hit.has_value() == inside);
            if (inside) CHECK(hit->distance == Approx(to.norm()).epsilon(1e-5));
            CHECK_FALSE(intersect(light, origin, -to.normalized()).has_value());
        }
    }
}

TEST_CASE("the density of sampling is that of meeting, and gives the solid angle") {
    const RectangleLight light = square_light({0, 0, 1.5f}, {0, 0, 0}, 2.0f, Color::Ones());
    std::mt19937 random(8);
    std::uniform_real_distribution<float> uniform;
    constexpr int kSamples = 100000;
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < kSamples; ++i) {
        const float u = uniform(random), v = uniform(random);
        const auto s = sample(light, Vec3::Zero(), u, v);
        REQUIRE(s.has_value());
        CHECK(s->wi.norm() == Approx(1.0f).epsilon(1e-5));
        CHECK((s->to_light - s->to_light.norm() * s->wi).norm() < 1e-5f);
        if (i < 1000 && std::max(std::abs(u - 0.5f), std::abs(v - 0.5f)) < 0.499f) {
            CHECK(intersect(light, Vec3::Zero(), s->wi).value().pdf == Approx(s->pdf).epsilon(1e-4));
        }
        sum += 1.0 / s->pdf;
        squares += 1.0 / (s->pdf * s->pdf);
    }
    const double mean = sum / kSamples, error = std::sqrt((squares / kSamples - mean * mean) / kSamples);
    const double solid_angle = 4.0 * std::asin(1.0 / (1.0 + 1.5 * 1.5));  // square of side 2 at height 1.5
    CHECK(std::abs(mean - solid_angle) < 4.0 * error);
}

TEST_CASE("a square light faces its target, with a horizontal edge") {
    const RectangleLight light = square_light({2, -2, 3.5f}, {0, 0, 0}, 1.0f, Color::Constant(40.0f));
    const Vec3 normal = cross(light.edge_u, light.edge_v);
    CHECK((normal - Vec3(-2, 2, -3.5f) / 4.5f).norm() < 1e-6f);
    CHECK(std::abs(light.edge_u.z()) < 1e-7f);
    CHECK(light.edge_u.norm() == Approx(1.0f));
    CHECK(light.edge_v.norm() == Approx(1.0f));
}
