#pragma once

#include <filesystem>
#include <string>

#include "morph/export/animation.h"

namespace automorph {

/// The axis of the meshes' coordinates that points up in viewers; glTF's own is y.
enum class UpAxis { Z, Y };

struct GlbOptions {
    AnimationOptions animation = {};
    UpAxis up = UpAxis::Z;
    std::string name = "morph";  ///< of the shape in viewers
};

/// Writes a morph as one self-contained binary file of glTF 2.0, as Blender, three.js and viewers play it:
///
///     node "automorph"   static: lifts the offset of the animation in place and turns `up` to glTF's y
///       node `name`      animated rotation and translation; its mesh has the morph's vertices in their
///       order,
///                        smooth normals, and the target(s) whose weights are animated
///
/// Coordinates are single precision relative to the centre of mass, so that shapes far from the origin keep
/// their detail; the offset is exact. Evaluated in double, frames are the library's own within 1e-6 of the
/// diagonal. Blender turns y up to z up as it reads: with UpAxis::Z its world coordinates are those of the
/// mesh files.
///
/// The file is written aside and renamed.
/// @pre animation.seconds > 0
/// @throws IoError if sizes are beyond what single precision holds, the file would exceed 4 GB, or it cannot
/// be
///         written
void write_glb(const std::filesystem::path& file, const Triangles& F, const Endpoints& ends,
               const GlbOptions& options = {});

/// True if the extension is .glb (any case).
bool is_glb_file(const std::filesystem::path& file);

}  // namespace automorph
