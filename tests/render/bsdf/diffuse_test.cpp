#include "render/bsdf/diffuse.h"

#include <cmath>

#include "tests/catch.h"
#include "tests/render/sampling.h"

using namespace automorph::render;

TEST_CASE("cosine sampling follows its density: chi-square over cells of equal probability") {
    constexpr int kRings = 16, kSectors = 32, kSamples = 1 << 18;
    const Diffuse diffuse(Color::Ones());
    Numbers numbers(5);
    EvenCells cells(kRings, kSectors);
    for (int i = 0; i < kSamples; ++i) {
        const float u = numbers(), v = numbers();
        const Vec3 wi = diffuse.sample(u, v).wi;
        // sin^2 and the azimuth are uniform under cos / pi.
        cells.add(1.0 - static_cast<double>(wi.z()) * wi.z(), wi.x(), wi.y());
    }
    CHECK(std::abs(cells.deviation()) < 3.9);  // probability below 1e-4
}

TEST_CASE("samples are unit vectors whose weight is f cos over the density") {
    const Color albedo(0.2f, 0.5f, 1.0f);
    const Diffuse diffuse(albedo);
    for (int i = 0; i < 64; ++i) {
        for (int j = 0; j < 64; ++j) {
            const BsdfSample s = diffuse.sample(static_cast<float>(i) / 64.0f, static_cast<float>(j) / 63.5f);
            CHECK(s.wi.norm() == Approx(1.0f).epsilon(2e-6));
            CHECK(s.pdf == Approx(diffuse.pdf(s.wi)));
            CHECK((s.weight - diffuse.evaluate(s.wi) / s.pdf).abs().maxCoeff() < 1e-6f);
        }
    }
}

TEST_CASE("reflected energy is the albedo, density integrates to one, nothing goes below") {
    const Color albedo(0.2f, 0.5f, 1.0f);
    const Diffuse diffuse(albedo);
    Eigen::Array3d energy = Eigen::Array3d::Zero();
    double density = 0.0;
    constexpr int kSteps = 1000;
    for (int i = 0; i < kSteps; ++i) {  // midpoint rule over z; the azimuth gives 2 pi
        const float z = (static_cast<float>(i) + 0.5f) / kSteps;
        const Vec3 wi(std::sqrt(1.0f - z * z), 0.0f, z);
        energy += diffuse.evaluate(wi).cast<double>() * (6.283185307179586 / kSteps);
        density += diffuse.pdf(wi) * (6.283185307179586 / kSteps);
    }
    CHECK((energy - albedo.cast<double>()).abs().maxCoeff() < 1e-5);
    CHECK(density == Approx(1.0).epsilon(1e-5));
    CHECK(diffuse.pdf(Vec3(0.6f, 0.0f, -0.8f)) == 0.0f);
    CHECK(diffuse.evaluate(Vec3(0.6f, 0.0f, -0.8f)).maxCoeff() == 0.0f);
}

TEST_CASE("the square maps to the disk with equal areas, its rim to the circle") {
    constexpr float kStep = 1e-3f;
    for (float u : {0.013f, 0.3f, 0.6f, 0.97f}) {
        for (float v : {0.021f, 0.41f, 0.55f, 0.93f}) {
            const Eigen::Vector2f du = sample_disk(u + kStep, v) - sample_disk(u - kStep, v);
            const Eigen::Vector2f dv = sample_disk(u, v + kStep) - sample_disk(u, v - kStep);
            const float area = std::abs(du.x() * dv.y() - du.y() * dv.x()) / (4 * kStep * kStep);
            CHECK(area == Approx(kPi).epsilon(2e-3));
        }
        CHECK(sample_disk(u, 0.0f).norm() == Approx(1.0f).epsilon(1e-6));
        CHECK(sample_disk(0.0f, u).norm() == Approx(1.0f).epsilon(1e-6));
        const float angle = std::atan2(sample_disk(1.0f, u).y(), sample_disk(1.0f, u).x());
        CHECK(angle == Approx(0.25f * kPi * (2.0f * u - 1.0f)).margin(1e-6));
    }
    CHECK(sample_disk(0.5f, 0.5f).norm() == 0.0f);
}

TEST_CASE("frames are orthonormal and right-handed for every normal") {
    for (const Vec3& n : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(0.6f, -0.48f, -0.64f),
                          Vec3(1e-4f, 1e-4f, -1.0f)}) {
        const Frame frame(n.normalized());
        CHECK((cross(frame.tangent, frame.bitangent) - frame.normal).norm() < 1e-6f);
        CHECK(frame.tangent.norm() == Approx(1.0f).epsilon(1e-6));
        CHECK(std::abs(frame.tangent.dot(frame.bitangent)) < 1e-6f);
        const Vec3 w = Vec3(0.3f, -0.5f, 0.8f).normalized();
        CHECK((frame.to_world(frame.to_local(w)) - w).norm() < 1e-6f);
    }
}
