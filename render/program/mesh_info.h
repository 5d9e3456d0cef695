#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "morph/mesh/admit.h"

namespace automorph::program {

/// All that can be said of a mesh file before a morph.
struct MeshInfo {
    struct Loop {
        int vertices = 0;
        double length = 0;  ///< scene units
    };
    std::string file;
    std::string refusal;  ///< why it cannot be read or morphed; empty: it can be

    bool readable = false;                        ///< what follows is known only of a file that can be read
    Eigen::Vector3d low{0, 0, 0}, high{0, 0, 0};  ///< bounding box of all vertices, scene units
    MeshInspection found;                         ///< as it is in the file

    // What follows is known only of a mesh that can be morphed.
    std::vector<std::string> mended;  ///< one sentence per mending
    MeshInspection admitted;          ///< after mending
    std::vector<Loop> loops;          ///< longest first: the border, then openings
    double area = 0;                  ///< squared scene units
    double volume = 0;                ///< cubed; of a closed mesh
};

/// Reads and examines; a file that cannot be read or morphed is a finding, not an error.
MeshInfo examine(const std::filesystem::path& file);

/// For a reader at a terminal; several lines, the last one ended.
std::string info_text(const MeshInfo& info);

/// A JSON array with one object per mesh.
std::string info_json(const std::vector<MeshInfo>& meshes);

}  // namespace automorph::program
