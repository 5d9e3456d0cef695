#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

/// What a mesh file says, before any mending: polygons of any size, vertices possibly duplicated or unused.
struct PolygonSoup {
    Points V;                                ///< #V x 3, in file order
    std::vector<int> polygon_start;          ///< #P + 1 offsets into polygon_vertices
    std::vector<int> polygon_vertices;       ///< indices into V, concatenated
    int polygon_count() const { return static_cast<int>(polygon_start.size()) - 1; }
};

/// Reads OFF, OBJ, PLY or STL (ASCII and binary where the format has it) by content and extension.
/// @throws IoError with `file:line:` (text) or `file: byte N:` (binary): what was expected, what was found
PolygonSoup read_mesh(const std::filesystem::path& file);

/// Writes by extension: .off, .obj, .ply (binary little endian), .stl (binary, single precision).
/// Coordinates in text formats are printed so that they read back to the same doubles. The file is written
/// aside and renamed, so that a reader never sees half of it.
/// @throws IoError if the extension is unknown or the file cannot be written
void write_mesh(const std::filesystem::path& file, const Mesh& mesh);

/// True if the extension is one that read_mesh and write_mesh know (any case).
bool is_mesh_file(const std::filesystem::path& file);

}  // namespace automorph
