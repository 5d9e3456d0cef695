#include "tests/render/compare/power_changes.h"

#include <Eigen/Geometry>
#include <numbers>
#include <vector>

namespace power {

using namespace automorph;
using namespace automorph::render;

const char* name(Change change) {
    switch (change) {
        case Change::None:
            return "nothing";
        case Change::Light:
            return "light +2 %";
        case Change::Albedo:
            return "albedo +1 %";
        case Change::Normal:
            return "one normal turned round";
        case Change::DarkTriangle:
            return "one triangle darker";
        case Change::Ring:
            return "one ring of triangles removed";
        case Change::Camera:
            return "camera turned by 0.1 degrees";
    }
    return "";
}

Triangles without_ring(const Triangles& F, int vertex) {
    std::vector<Eigen::Index> kept;
    for (Eigen::Index f = 0; f < F.rows(); ++f) {
        if ((F.row(f).array() != vertex).all()) kept.push_back(f);
    }
    return F(kept, Eigen::all);
}

Camera turned(Camera camera, double degrees) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, camera.up.normalized()).toRotationMatrix();
    camera.target = camera.position + turn * (camera.target - camera.position);
    return camera;
}

}  // namespace power
