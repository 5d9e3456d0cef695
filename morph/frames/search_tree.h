#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <memory>

namespace automorph {

struct ReleaseScene {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
/// A tree of one geometry.
using SearchTree = std::unique_ptr<RTCSceneTy, ReleaseScene>;

/// A device of Embree's: the one door of morph to that library. It may use all threads that TBB may: one with
/// `threads=1` would leave the whole process a single one while it lives.
class SearchDevice {
public:
    /// @throws SolverFailure Embree could not be started
    SearchDevice();
    ~SearchDevice() { rtcReleaseDevice(device_); }
    SearchDevice(const SearchDevice&) = delete;

    RTCGeometry geometry(RTCGeometryType type) const { return rtcNewGeometry(device_, type); }
    /// Takes the geometry over.
    /// @throws SolverFailure the tree could not be built, or the geometry's buffers not be had
    SearchTree tree(RTCGeometry geometry, RTCSceneFlags flags) const;

private:
    RTCDevice device_;
};

}  // namespace automorph
