#include "render/bsdf/bsdf.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "morph/mesh/errors.h"
#include "tests/catch.h"
#include "tests/render/sampling.h"

using namespace automorph;
using namespace automorph::render;

namespace {

struct Case {
    std::string name;
    Material material;
};

Material material_of(float metallic, float transmission, float specular, float roughness) {
    Material m;
    m.base_color = {0.9f, 0.6f, 0.3f};
    m.metallic = metallic;
    m.transmission = transmission;
    m.specular = specular;
    m.roughness = roughness;
    return m;
}

std::vector<Case> rough_materials() {
    return {{"diffuse", material_of(0, 0, 0, 0.5f)},        {"metal", material_of(1, 0, 0, 0.4472136f)},
            {"rough metal", material_of(1, 0, 0, 1.0f)},    {"plastic", material_of(0, 0, 1, 0.4f)},
            {"half a coat", material_of(0, 0, 0.5f, 0.7f)}, {"rough glass", material_of(0, 1, 0, 0.6f)},
            {"all three", material_of(0.3f, 0.5f, 1, 0.5f)}};
}

// Reflected energy: midpoint rule over the sphere.
Eigen::Array3d energy_of(const Bsdf& bsdf, int steps) {
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    for (int i = 0; i < 2 * steps; ++i) {
        for (int j = 0; j < 4 * steps; ++j) {
            const Vec3 w = direction((i + 0.5) / steps - 1.0, kTwoPi * (j + 0.5) / (4 * steps));
            sum += bsdf.evaluate(w).f_cos.cast<double>();
        }
    }
    return sum * (kTwoPi / (4.0 * steps * steps));
}

}  // namespace

TEST_CASE("every sampler follows its density: chi-square over cells of the sphere", "[sweep]") {
    constexpr int kRings = 20, kSectors = 20, kSamples = 100000;
    for (const Case& c : rough_materials()) {
        const PreparedMaterial prepared(c.material);
        const int fine = c.material.transmission > 0.0f ? 24 : 10;  // refraction ends abruptly
        for (double z : {0.95, 0.5, 0.15}) {
            for (bool front : {true, false}) {
                INFO(c.name << ", cosine " << z << (front ? ", front" : ", back"));
                const Bsdf bsdf(prepared, c.material.base_color, direction(z, 0.7), front);
                std::vector<double> expected(kRings * kSectors, 0.0), found(kRings * kSectors, 0.0);
                for (int i = 0; i < kRings * fine; ++i) {
                    for (int j = 0; j < kSectors * fine; ++j) {
                        const Vec3 w = direction(2.0 * (i + 0.5) / (kRings * fine) - 1.0,
                                                 kTwoPi * (j + 0.5) / (kSectors * fine));
                        expected[static_cast<std::size_t>(i / fine * kSectors + j / fine)] +=
                            static_cast<double>(bsdf.evaluate(w).pdf) * 2.0 * kTwoPi /
                            (kRings * kSectors * fine * fine);
                    }
                }
                Numbers numbers(11);
                double none = kSamples;
                for (int k = 0; k < kSamples; ++k) {
                    const float u = numbers(), v = numbers();
                    float choice = numbers();
                    const auto s = bsdf.sample(u, v, choice);
                    if (!s) continue;
                    none -= 1.0;
                    const double turn = std::atan2(s->wi.y(), s->wi.x()) / kTwoPi;
                    const int ring = std::min(kRings - 1, static_cast<int>((s->wi.z() + 1.0) / 2.0 * kRings));
                    const int sector =
                        std::min(kSectors - 1, static_cast<int>((turn < 0 ? turn + 1 : turn) * kSectors));
                    found[static_cast<std::size_t>(ring * kSectors + sector)] += 1.0;
                }
                // Cells that expect few samples are taken together, and those without any direction belong
                // there.
                double chi2 = 0.0, rest_expected = 0.0, rest_found = none, density = 0.0;
                int freedom = 0;
                for (std::size_t i = 0; i < expected.size(); ++i) {
                    density += expected[i];
                    const double e = expected[i] * kSamples;
                    if (e < 20.0) {
                        rest_expected += e;
                        rest_found += found[i];
                        continue;
                    }
                    chi2 += (found[i] - e) * (found[i] - e) / e;
                    ++freedom;
                }
                rest_expected += (1.0 - density) * kSamples;
                if (rest_expected > 20.0) {
                    chi2 += (rest_found - rest_expected) * (rest_found - rest_expected) / rest_expected;
                    ++freedom;
                }
                CHECK(density < 1.002);
                CHECK(freedom > 20);
                CHECK(chi2 < freedom + 4.0 * std::sqrt(2.0 * freedom));
            }
        }
    }
}

TEST_CASE("samples of every material are unit vectors whose weight is f cos over the density") {
    Numbers numbers(11);
    for (const Case& c : rough_materials()) {
        const PreparedMaterial prepared(c.material);
        for (bool front : {true, false}) {
            const Bsdf bsdf(prepared, c.material.base_color, direction(0.6, 2.0), front);
            for (int k = 0; k < 2000; ++k) {
                const float u = numbers(), v = numbers();
                float choice = numbers();
                const auto s = bsdf.sample(u, v, choice);
                REQUIRE((choice >= 0.0f && choice < 1.0f));
                if (!s) continue;
                REQUIRE(s->wi.norm() == Approx(1.0f).epsilon(1e-4));
                const BsdfValue value = bsdf.evaluate(s->wi);
                REQUIRE(value.pdf == Approx(s->pdf));
                REQUIRE((s->weight - value.f_cos / value.pdf).abs().maxCoeff() < 1e-4f);
            }
        }
    }
}

TEST_CASE("what decides between kinds of surface stays uniform") {
    const Case c = rough_materials().back();
    const PreparedMaterial prepared(c.material);
    const Bsdf bsdf(prepared, c.material.base_color, direction(0.6, 2.0), true);
    Numbers numbers(11);
    double sum = 0.0, squares = 0.0;
    constexpr int kSamples = 100000;
    for (int k = 0; k < kSamples; ++k) {
        const float u = numbers(), v = numbers();
        float choice = numbers();
        bsdf.sample(u, v, choice);
        sum += static_cast<double>(choice) / kSamples;
        squares += static_cast<double>(choice) * static_cast<double>(choice) / kSamples;
    }
    CHECK(sum == Approx(0.5).margin(0.005));
    CHECK(squares == Approx(1.0 / 3.0).margin(0.005));
}

TEST_CASE("scattering is reciprocal") {
    Numbers numbers(11);
    for (const Case& c : rough_materials()) {
        INFO(c.name);
        const PreparedMaterial prepared(c.material);
        for (int k = 0; k < 300; ++k) {
            const Vec3 a = direction(0.05 + 0.95 * static_cast<double>(numbers()),
                                     kTwoPi * static_cast<double>(numbers()));
            const Vec3 b = direction(0.05 + 0.95 * static_cast<double>(numbers()),
                                     kTwoPi * static_cast<double>(numbers()));
            const Color there = Bsdf(prepared, c.material.base_color, a, true).evaluate(b).f_cos / b.z();
            const Color back = Bsdf(prepared, c.material.base_color, b, true).evaluate(a).f_cos / a.z();
            REQUIRE((there - back).abs().maxCoeff() <= 2e-4f * there.maxCoeff() + 1e-7f);
            // Through the surface: seen from the other side, up is down; radiance scales by the index
            // squared.
            const Vec3 below(b.x(), b.y(), -b.z()), other_side(a.x(), a.y(), -a.z());
            const float eta2 = c.material.ior * c.material.ior;
            const Color in = Bsdf(prepared, c.material.base_color, a, true).evaluate(below).f_cos / b.z();
            const Color out =
                Bsdf(prepared, c.material.base_color, b, false).evaluate(other_side).f_cos / a.z();
            REQUIRE((eta2 * in - out).abs().maxCoeff() <= 5e-4f * eta2 * in.maxCoeff() + 1e-7f);
        }
    }
}

TEST_CASE("metal of alpha 0.2 reflects the known share of even light") {
    Material m = material_of(1, 0, 0, std::sqrt(0.2f));
    m.base_color = m.edge_color = Color::Ones();
    const PreparedMaterial prepared(m);
    for (const auto& [degrees, share] :
         {std::pair{0.0, 0.94766}, std::pair{60.0, 0.89411}, std::pair{80.0, 0.84788}}) {
        const Bsdf bsdf(prepared, m.base_color, direction(std::cos(degrees / 360.0 * kTwoPi), 0.3), true);
        const Eigen::Array3d energy = energy_of(bsdf, 500);
        CHECK(energy[0] == Approx(share).margin(3e-4));
    }
}

TEST_CASE("white plastic reflects all light, coloured plastic less") {
    for (float roughness : {0.3f, 0.5f, 1.0f}) {
        for (float ior : {1.3f, 1.5f, 2.5f}) {
            Material m = material_of(0, 0, 1, roughness);
            m.base_color = {1.0f, 0.5f, 0.0f};
            m.ior = ior;
            const PreparedMaterial prepared(m);
            for (double z : {1.0, 0.6, 0.3}) {
                const Bsdf bsdf(prepared, m.base_color, direction(z, 0.3), true);
                const Eigen::Array3d energy = energy_of(bsdf, 200);
                INFO("roughness " << roughness << ", ior " << ior << ", cosine " << z);
                CHECK(energy[0] == Approx(1.0).margin(0.004));
                CHECK(energy[1] == Approx(0.5 * (energy[0] + energy[2])).margin(1e-3));
                CHECK(energy[2] > 0.004);
            }
        }
    }
}

TEST_CASE("no material reflects more than it gets", "[sweep]") {
    Numbers numbers(11);
    for (const Case& c : rough_materials()) {
        for (float roughness : {0.0f, 0.1f, 0.3f, 0.6f, 1.0f}) {
            Material m = c.material;
            m.roughness = roughness;
            m.base_color.setOnes();
            const PreparedMaterial prepared(m);
            for (double z : {1.0, 0.5, 0.1, 0.02}) {
                for (bool front : {true, false}) {
                    const Bsdf bsdf(prepared, m.base_color, direction(z, 1.0), front);
                    constexpr int kSamples = 20000;
                    double energy = 0.0;
                    for (int k = 0; k < kSamples; ++k) {
                        const float u = numbers(), v = numbers();
                        float choice = numbers();
                        const auto s = bsdf.sample(u, v, choice);
                        if (s) energy += static_cast<double>(s->weight[1] * s->density) / kSamples;
                    }
                    INFO(c.name << ", roughness " << roughness << ", cosine " << z);
                    CHECK(energy < 1.01);
                    CHECK(energy > 0.3);
                }
            }
        }
    }
}

TEST_CASE("smooth glass reflects by Fresnel's law, refracts by Snell's, and loses nothing") {
    Material m = material_of(0, 1, 0, 0);
    m.base_color.setOnes();
    const PreparedMaterial prepared(m);
    for (bool front : {true, false}) {
        const float eta = front ? 1.5f : 1.0f / 1.5f;
        for (double z : {1.0, 0.9, 0.5, 0.1}) {
            const Vec3 wo = direction(z, 0.4);
            const Bsdf bsdf(prepared, m.base_color, wo, front);
            float reflected = 0.0f;
            constexpr int kSteps = 10000;
            for (int k = 0; k < kSteps; ++k) {
                float choice = (static_cast<float>(k) + 0.5f) / kSteps;
                const auto s = bsdf.sample(0.3f, 0.7f, choice).value();
                CHECK(std::isinf(s.pdf));
                CHECK(s.weight[0] * s.density == Approx(1.0f));
                if (s.wi.z() > 0.0f) {
                    reflected += 1.0f / kSteps;
                    REQUIRE((s.wi - Vec3(-wo.x(), -wo.y(), wo.z())).norm() < 1e-6f);
                } else {
                    REQUIRE(s.wi.norm() == Approx(1.0f));
                    REQUIRE((eta * s.wi.head<2>() + wo.head<2>()).norm() < 1e-6f);
                }
            }
            CHECK(reflected == Approx(fresnel(wo.z(), eta)).margin(2e-4));
        }
    }
    CHECK(fresnel(1.0f, 1.5f) == Approx(0.04f));
    CHECK(fresnel(1.0f, 1.0f / 1.5f) == Approx(0.04f));
    CHECK(fresnel(0.5f, 1.0f / 1.5f) == 1.0f);
    CHECK(fresnel(0.5547002f, 1.5f) == Approx(0.5f * 0.1479290f).epsilon(1e-4));  // Brewster's angle
}

TEST_CASE("glass of index one is not there") {
    Material m = material_of(0, 1, 0, 0.5f);
    m.base_color.setOnes();
    m.ior = 1.0f;
    const PreparedMaterial prepared(m);
    const Bsdf bsdf(prepared, m.base_color, direction(0.4, 0.4), true);
    float choice = 0.5f;
    const auto s = bsdf.sample(0.3f, 0.7f, choice).value();
    CHECK((s.wi + direction(0.4, 0.4)).norm() < 1e-6f);
    CHECK(s.weight[0] == 1.0f);
}

TEST_CASE("parameters out of range are refused by name") {
    const auto refuse = [](const char* name, const auto& set) {
        Material m;
        set(m);
        try {
            PreparedMaterial{m};
            FAIL(name);
        } catch (const ConfigError& error) {
            CHECK(std::string(error.what()).find(name) != std::string::npos);
        }
    };
    refuse("metallic", [](Material& m) { m.metallic = 1.5f; });
    refuse("transmission", [](Material& m) { m.transmission = -0.1f; });
    refuse("roughness", [](Material& m) { m.roughness = std::numeric_limits<float>::quiet_NaN(); });
    refuse("specular", [](Material& m) { m.specular = 2.0f; });
    refuse("ior", [](Material& m) { m.ior = 0.9f; });
}
