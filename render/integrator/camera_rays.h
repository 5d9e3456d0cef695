#pragma once

#include "render/camera/camera.h"
#include "render/film/filter.h"
#include "render/integrator/sample_numbers.h"
#include "render/math/ray.h"

namespace automorph::render {

/// The rays that a picture's samples start with: through the pixel filter, from the lens, in the exposure.
class CameraRays {
public:
    /// @param camera  must outlive this object
    /// @param motion  whether anything moves during the exposure
    CameraRays(const PictureCamera& camera, Filter filter, bool motion)
        : camera_(camera), filter_(filter), motion_(motion) {}

    Ray operator()(int x, int y, const SampleNumbers& random) const {
        const Sample2 place = random(kPixel);
        const float px = static_cast<float>(x) + 0.5f + filter_(place.u),
                    py = static_cast<float>(y) + 0.5f + filter_(place.v);
        Ray ray{camera_.origin(), camera_.direction(px, py)};
        if (camera_.has_lens()) {
            const Sample2 lens = random(kLens);
            ray = camera_.lens_ray(px, py, lens.u, lens.v);
        }
        if (motion_) ray.time = random(kTime).u;
        return ray;
    }

private:
    const PictureCamera& camera_;
    FilterSampler filter_;
    bool motion_;
};

}  // namespace automorph::render
