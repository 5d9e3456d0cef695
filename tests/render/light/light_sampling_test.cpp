// Samplers of lights against their densities.
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "morph/mesh/errors.h"
#include "render/light/light_set.h"
#include "tests/catch.h"
#include "tests/render/day_sky.h"
#include "tests/render/sampling.h"

using namespace automorph;
using namespace automorph::render;

namespace {

// Chi-square over cells of the sphere that expect enough samples. Densities jump at the edges of lights, so
// their integrals over cells are taken finely.
void check_sampler(const std::string& name,
                   const std::function<std::optional<LightSample>(float, float, float)>& sample,
                   const std::function<float(const Vec3&)>& pdf) {
    constexpr int kRings = 24, kSectors = 48, kFine = 24, kSamples = 60000;
    std::vector<double> expected(kRings * kSectors, 0.0), found(kRings * kSectors, 0.0);
    for (int i = 0; i < kRings * kFine; ++i) {
        for (int j = 0; j < kSectors * kFine; ++j) {
            const Vec3 w =
                direction(2.0 * (i + 0.5) / (kRings * kFine) - 1.0, kTwoPi * (j + 0.5) / (kSectors * kFine));
            expected[static_cast<std::size_t>(i / kFine * kSectors + j / kFine)] +=
                static_cast<double>(pdf(w)) * 2.0 * kTwoPi * kSamples / (kRings * kSectors * kFine * kFine);
        }
    }
    Numbers numbers(5);
    for (int k = 0; k < kSamples; ++k) {
        const float choice = numbers(), u = numbers(), v = numbers();
        const auto s = sample(choice, u, v);
        REQUIRE(s.has_value());
        if (k < 2000) {
            REQUIRE(s->wi.norm() == Approx(1.0f).epsilon(1e-5));
            REQUIRE((s->to_light.normalized() - s->wi).norm() < 1e-5f);
        }
        const double turn = std::atan2(s->wi.y(), s->wi.x()) / kTwoPi;
        const int ring = std::min(kRings - 1, static_cast<int>((s->wi.z() + 1.0) / 2.0 * kRings));
        const int sector = std::min(kSectors - 1, static_cast<int>((turn < 0 ? turn + 1 : turn) * kSectors));
        found[static_cast<std::size_t>(ring * kSectors + sector)] += 1.0;
    }
    double chi2 = 0.0, rest_expected = 0.0, rest_found = 0.0, total = 0.0;
    int freedom = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        total += expected[i];
        if (expected[i] < 25.0) {
            rest_expected += expected[i];
            rest_found += found[i];
            continue;
        }
        chi2 += (found[i] - expected[i]) * (found[i] - expected[i]) / expected[i];
        ++freedom;
    }
    INFO(name << ": chi-square " << chi2 << ", " << freedom << " cells, integral " << total / kSamples);
    CHECK(total / kSamples == Approx(1.0).margin(0.004));
    CHECK(rest_found == Approx(rest_expected).margin(5.0 * std::sqrt(rest_expected) + 0.003 * kSamples));
    CHECK(freedom >= 10);
    CHECK(chi2 < 1.15 * freedom + 4.0 * std::sqrt(2.0 * freedom));
}

RectangleLight near_rectangle() {
    RectangleLight light;
    light.center = {0.4f, -0.3f, 1.0f};
    light.edge_u = {1.6f, 0.0f, 1.2f};
    light.edge_v = {0.0f, -2.0f, 0.0f};
    return light;
}

Image uneven_map() {
    Image image(16, 8, 3, 0.0f);
    for (int row = 0; row < 8; ++row) {
        for (int column = 0; column < 16; ++column) {
            if (row == 3 || column == 7) continue;  // black ones are never sampled
            for (int c = 0; c < 3; ++c)
                image.at(column, row)[c] = static_cast<float>((5 * row + 7 * column + c) % 11);
        }
    }
    return image;
}

}  // namespace

TEST_CASE("every light's sampler follows its density: chi-square over cells of the sphere") {
    const Vec3 point(0.1f, 0.2f, -0.3f);
    const RectangleLight rectangle = near_rectangle();
    check_sampler(
        "rectangle", [&](float, float u, float v) { return sample(rectangle, point, u, v); },
        [&](const Vec3& w) {
            const auto hit = intersect(rectangle, point, w);
            return hit ? hit->pdf : 0.0f;
        });
    for (float radius : {0.6f, 1.2f}) {
        const SphereLight sphere{{0.5f, -1.0f, 0.4f}, radius, Color::Ones(), true};
        check_sampler(
            "sphere", [&](float, float u, float v) { return sample(sphere, point, u, v); },
            [&](const Vec3& w) {
                const auto hit = intersect(sphere, point, w);
                return hit ? hit->pdf : 0.0f;
            });
    }
    const EquirectangularMap map(uneven_map());
    check_sampler(
        "map", [&](float, float u, float v) { return map.sample(u, v); },
        [&](const Vec3& w) { return map.pdf(w); });
}

TEST_CASE("a set of lights is sampled with the density it states") {
    const Vec3 point(0.1f, 0.2f, -0.3f);
    Sky sky;
    sky.map = std::make_shared<EquirectangularMap>(uneven_map());
    RectangleLight behind = near_rectangle();  // shines away: never chosen
    behind.edge_v = -behind.edge_v;
    const std::vector<RectangleLight> rectangles{near_rectangle(), behind};
    const std::vector<SphereLight> spheres{{{-0.5f, -1.0f, 0.4f}, 0.9f, Color::Constant(40.0f), true}};
    const LightSet set(rectangles, spheres, sky);
    const LitPoint lit{point, Vec3(0.6f, 0.0f, 0.8f)};
    CHECK(set.size() == 4);
    check_sampler(
        "set", [&](float choice, float u, float v) { return set.sample(lit, choice, u, v); },
        [&](const Vec3& w) {
            float sum = set.map_pdf(lit, w);
            const auto add = [&](const auto&, float pdf) {
                sum += pdf;
                return 0.0f;
            };
            set.met(lit, w, 1e30f, add);
            return sum;
        });
}

TEST_CASE("samples of a sphere lie on it, towards the point; inside there are none") {
    const SphereLight sphere{{0.5f, -1.0f, 0.4f}, 0.6f, Color::Ones(), true};
    Numbers numbers(5);
    for (double distance : {0.61, 1.0, 10.0, 1e4}) {
        const Vec3 point = sphere.center + static_cast<float>(distance) * Vec3(0.6f, 0.0f, 0.8f);
        for (int k = 0; k < 1000; ++k) {
            const float u = numbers(), v = numbers();
            const LightSample s = sample(sphere, point, u, v).value();
            const Vec3 from_center = point + s.to_light - sphere.center;
            REQUIRE(from_center.norm() == Approx(0.6f).epsilon(1e-4 + 1e-6 * distance));
            REQUIRE(s.wi.dot(from_center) < 1e-3f);
            // All but the rim is met by the ray of the sample, at the same distance and density.
            if (s.wi.dot(from_center.normalized()) > -0.1f || distance > 100.0) continue;
            const LightHit hit = intersect(sphere, point, s.wi).value();
            REQUIRE(hit.distance == Approx(s.to_light.norm()).epsilon(1e-3));
            REQUIRE(hit.pdf == Approx(s.pdf));
        }
    }
    CHECK_FALSE(sample(sphere, sphere.center + Vec3(0.1f, 0, 0), 0.5f, 0.5f).has_value());
    CHECK_FALSE(intersect(sphere, sphere.center + Vec3(0.1f, 0, 0), {1, 0, 0}).has_value());
    CHECK_FALSE(intersect(sphere, {5, 5, 5}, Vec3(1, 1, 1).normalized()).has_value());
}

TEST_CASE("irradiance of a sphere has its closed form, also where the horizon cuts it") {
    const SphereLight sphere{{0.0f, 0.0f, 2.0f}, 1.0f, Color(1.0f, 2.0f, 3.0f), true};
    CHECK(irradiance(sphere, Vec3::Zero(), {0, 0, 1})[0] == Approx(kPi / 4.0f));
    CHECK(irradiance(sphere, Vec3::Zero(), {0, 0, 1})[2] == Approx(3.0f * kPi / 4.0f));
    CHECK(irradiance(sphere, Vec3::Zero(), {0, 0, -1})[0] == 0.0f);
    Numbers numbers(5);
    for (double degrees : {30.0, 65.0, 80.0, 90.0, 100.0, 115.0}) {
        const double a = degrees / 360.0 * kTwoPi;
        const Vec3 normal(static_cast<float>(std::sin(a)), 0.0f, static_cast<float>(std::cos(a)));
        double sum = 0.0, squares = 0.0;
        constexpr int kSamples = 100000;
        for (int k = 0; k < kSamples; ++k) {
            const float u = numbers(), v = numbers();
            const LightSample s = sample(sphere, Vec3::Zero(), u, v).value();
            const auto x = static_cast<double>(std::max(0.0f, s.wi.dot(normal)) / s.pdf);
            sum += x / kSamples;
            squares += x * x / kSamples;
        }
        const double error = std::sqrt((squares - sum * sum) / kSamples);
        INFO(degrees);
        CHECK(std::abs(static_cast<double>(irradiance(sphere, Vec3::Zero(), normal)[0]) - sum) <
              4.0 * error + 1e-6);
    }
}

TEST_CASE("a map gives the radiance of its texels in the stated directions") {
    Image image(4, 2, 3, 0.0f);
    image.at(2, 0)[0] = 5.0f;  // phi in [0, 90] degrees, above the horizon
    image.at(0, 1)[1] = 7.0f;  // phi in [-180, -90], below
    const EquirectangularMap map(image);
    CHECK(map({0.5f, -0.5f, 0.5f})[0] == 5.0f);
    CHECK(map({0.5f, 0.5f, 0.5f})[0] == 0.0f);
    CHECK(map({-0.5f, 0.5f, -0.5f})[1] == 7.0f);
    CHECK(map({0.5f, -0.5f, -0.5f}).maxCoeff() == 0.0f);
    CHECK(map.power() == Approx(12.0 / 3.0 * kTwoPi / 4.0));
    CHECK(map({0.0f, 0.0f, 1.0f}).isFinite().all());
    CHECK(map({0.0f, 0.0f, -1.0f}).isFinite().all());
    const EquirectangularMap black(Image(4, 2));
    CHECK_FALSE(black.sample(0.5f, 0.5f).has_value());
    CHECK(black.pdf({0, 0, 1}) == 0.0f);
}

TEST_CASE("the day sky has the known irradiance") {
    const EquirectangularMap map(day_sky());
    // The radiance of a white plane, from exact solid angles.
    const Color radiance = map.irradiance({0, 0, 1}) * kInvPi;
    for (int c = 0; c < 3; ++c) CHECK(radiance[c] == Approx(kDaySkyPlane[c]).epsilon(1e-4));
}

TEST_CASE("the largest and smallest numbers stay within the map and off its black texels") {
    for (const Image& image : {uneven_map(), day_sky()}) {
        const EquirectangularMap map(image);
        for (float u : {0.0f, 0x0.ffffffp0f}) {
            for (float v : {0.0f, 0x0.ffffffp0f}) {
                const LightSample s = map.sample(u, v).value();
                CHECK(s.wi.allFinite());
                CHECK(s.pdf > 0.0f);
                CHECK(s.radiance.maxCoeff() > 0.0f);
            }
        }
    }
}

TEST_CASE("a gradient sky goes from horizon to zenith, its irradiance is its cosine integral") {
    Sky sky;
    sky.radiance = {0.5f, 0.0f, 0.0f};
    sky.gradient = SkyGradient{{0.0f, 1.0f, 1.0f}, {0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 2.0f}, {0, 0, 1}};
    CHECK(sky({0, 0, 1}).isApprox(Color(0.5f, 1.0f, 1.0f)));
    CHECK(sky({0.8f, 0.0f, 0.6f})[1] == Approx(std::sqrt(0.6f)));
    CHECK(sky({0.8f, 0.0f, -0.6f}).isApprox(Color(0.5f, 0.0f, 2.0f)));
    const Color up = irradiance(sky, {0, 0, 1}), side = irradiance(sky, {1, 0, 0}),
                down = irradiance(sky, {0, 0, -1});
    CHECK(up[0] == Approx(0.5f * kPi).epsilon(1e-4));
    CHECK(up[1] == Approx(0.8f * kPi).epsilon(5e-4));  // 2 pi times the integral of z^1.5
    CHECK(side[2] == Approx(1.5f * kPi).epsilon(1e-4));
    CHECK(down[2] == Approx(2.0f * kPi).epsilon(1e-4));
}

TEST_CASE("maps that are no radiance are refused with the place") {
    Image image(4, 2, 3, 1.0f);
    image.at(1, 1)[2] = -1.0f;
    try {
        EquirectangularMap{image};
        FAIL("no error");
    } catch (const ConfigError& error) {
        CHECK(std::string(error.what()).find("(1, 1)") != std::string::npos);
    }
    CHECK_THROWS_AS(EquirectangularMap{Image()}, ConfigError);
    CHECK_THROWS_AS(EquirectangularMap{Image(4, 2, 2)}, ConfigError);
}

TEST_CASE("a turned map shows its picture along its axes, and its sampler follows it") {
    const Image picture = uneven_map();
    const MapAxes axes{{0.0f, 0.6f, -0.8f}, {1.0f, 0.0f, 0.0f}, {0.0f, -0.8f, -0.6f}};
    const EquirectangularMap straight(picture), turned(picture, axes);
    const auto to_world = [&](const Vec3& w) {
        return Vec3(w.x() * axes.middle + w.y() * axes.left + w.z() * axes.zenith);
    };
    CHECK(turned.power() == straight.power());
    for (const double z : {-0.83, -0.21, 0.02, 0.55, 0.97}) {
        for (int k = 0; k < 30; ++k) {
            const Vec3 w = direction(z, kTwoPi * (k + 0.3) / 30);
            CHECK((turned(to_world(w)) == straight(w)).all());
            CHECK(turned.irradiance(to_world(w))[1] == Approx(straight.irradiance(w)[1]).epsilon(1e-4));
        }
    }
    check_sampler(
        "turned map", [&](float, float u, float v) { return turned.sample(u, v); },
        [&](const Vec3& w) { return turned.pdf(w); });
}
