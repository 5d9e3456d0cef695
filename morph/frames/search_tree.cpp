#include "morph/frames/search_tree.h"

#include "morph/mesh/errors.h"

namespace automorph {

SearchDevice::SearchDevice() : device_(rtcNewDevice(nullptr)) {
    if (!device_) throw SolverFailure("self-intersections: Embree could not be started");
}

SearchTree SearchDevice::tree(RTCGeometry geometry, RTCSceneFlags flags) const {
    SearchTree scene(rtcNewScene(device_));
    rtcSetSceneFlags(scene.get(), flags);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene.get());
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE)
        throw SolverFailure("self-intersections: Embree could not build its tree");
    return scene;
}

}  // namespace automorph
