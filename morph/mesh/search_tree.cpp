#include "morph/mesh/search_tree.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "morph/mesh/errors.h"

namespace automorph {

UnitFrame::UnitFrame(const Points& V) {
    const Eigen::RowVector3d low = V.colwise().minCoeff(), high = V.colwise().maxCoeff();
    centre = 0.5 * (low + high);
    size = std::max((high - low).norm(), std::numeric_limits<double>::min());
}

SearchDevice::SearchDevice(std::string stage) : stage_(std::move(stage)), device_(rtcNewDevice(nullptr)) {
    if (!device_) throw SolverFailure(stage_ + ": Embree could not be started");
}

SearchTree SearchDevice::tree(RTCGeometry geometry, RTCSceneFlags flags) const {
    SearchTree scene(rtcNewScene(device_));
    rtcSetSceneFlags(scene.get(), flags);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene.get());
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE)
        throw SolverFailure(stage_ + ": Embree could not build its tree");
    return scene;
}

}  // namespace automorph
