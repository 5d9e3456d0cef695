#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <memory>
#include <string>

#include "morph/mesh/mesh.h"

namespace automorph {

/// A mesh's place and size. Embree's coordinates are floats: a mesh is handed to it about the origin and of
/// size 1.
struct UnitFrame {
    Eigen::RowVector3d centre;  ///< of the bounding box
    double size;                ///< diagonal of the bounding box, > 0

    /// The frame of a mesh that has vertices.
    explicit UnitFrame(const Points& V);

    Points in(const Points& V) const { return (V.rowwise() - centre) / size; }
};

struct ReleaseScene {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
/// A tree of one geometry.
using SearchTree = std::unique_ptr<RTCSceneTy, ReleaseScene>;

/// A device of Embree's: the one door of morph to that library. It may use all threads that TBB may: one with
/// `threads=1` would leave the whole process a single one while it lives.
class SearchDevice {
public:
    /// @param stage  named in errors
    /// @throws SolverFailure Embree could not be started
    explicit SearchDevice(std::string stage);
    ~SearchDevice() { rtcReleaseDevice(device_); }
    SearchDevice(const SearchDevice&) = delete;

    RTCGeometry geometry(RTCGeometryType type) const { return rtcNewGeometry(device_, type); }
    /// Takes the geometry over.
    /// @throws SolverFailure the tree could not be built, or the geometry's buffers not be had
    SearchTree tree(RTCGeometry geometry, RTCSceneFlags flags) const;

private:
    std::string stage_;
    RTCDevice device_;
};

}  // namespace automorph
