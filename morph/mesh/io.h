#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

/// What a mesh file says, before any mending: polygons of any size, vertices possibly duplicated or unused.
struct PolygonSoup {
    Points V;                           ///< #V x 3, in file order
    std::vector<int> polygon_start{0};  ///< #P + 1 offsets into polygon_vertices
    std::vector<int> polygon_vertices;  ///< indices into V, concatenated
    int polygon_count() const { return static_cast<int>(polygon_start.size()) - 1; }
};

/// Reads OFF, OBJ, PLY or STL (ASCII and binary where the format has it). The extension names the format, the
/// content is checked against it.
/// @throws IoError with `file:line:` (text) or `file: byte N:` (binary): what was expected, what was found
PolygonSoup read_mesh(const std::filesystem::path& file);

/// The same for a file in memory; `name` gives the extension and names the file in errors.
PolygonSoup parse_mesh(std::string_view bytes, const std::string& name);

/// Writes by extension: .off, .obj, .ply (binary little endian, double), .stl (binary, single precision).
/// All but STL read back to the same doubles. The file is written aside and renamed, so that a reader never
/// sees half of it; on failure nothing is left behind and an existing file stays as it was.
/// @throws IoError if the extension is unknown, a coordinate is beyond what read_mesh accepts, or the file
/// cannot be written
void write_mesh(const std::filesystem::path& file, const Mesh& mesh);

/// A triangle mesh as a soup, e.g. to admit() a mesh made in memory.
PolygonSoup polygon_soup(const Mesh& mesh);

/// True if the extension is one that read_mesh and write_mesh know (any case).
bool is_mesh_file(const std::filesystem::path& file);

}  // namespace automorph
