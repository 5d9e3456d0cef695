#include "render/light/sky.h"

#include <algorithm>
#include <cmath>

#include "render/math/disk.h"

namespace automorph::render {

Color SkyGradient::operator()(const Vec3& direction) const {
    const float height = direction.dot(up);
    if (height < 0.0f) return ground;
    return horizon + std::sqrt(height) * (zenith - horizon);
}

Color irradiance(const Sky& sky, const Vec3& normal) {
    Color sum = kPi * sky.radiance;
    if (sky.gradient) {
        // The mean over a regular grid of directions whose density is the cosine's.
        constexpr int kGrid = 256;
        const Frame frame(normal);
        Eigen::Array3d mean = Eigen::Array3d::Zero();
        for (int i = 0; i < kGrid; ++i) {
            for (int j = 0; j < kGrid; ++j) {
                const Eigen::Vector2f disk = sample_disk((static_cast<float>(i) + 0.5f) / kGrid,
                                                         (static_cast<float>(j) + 0.5f) / kGrid);
                const float z = std::sqrt(std::max(0.0f, 1.0f - disk.squaredNorm()));
                mean += (*sky.gradient)(frame.to_world({disk.x(), disk.y(), z})).cast<double>();
            }
        }
        sum += kPi * (mean / (kGrid * kGrid)).cast<float>();
    }
    if (sky.map) sum += sky.map->irradiance(normal);
    return sum;
}

}  // namespace automorph::render
