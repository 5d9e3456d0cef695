#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "morph/mesh/io.h"
#include "morph/mesh/text_cursor.h"

namespace automorph {

enum class MeshFormat { Unknown, Off, Obj, Ply, Stl };

/// The format that a file's extension names, in any case.
MeshFormat format_of_name(const std::filesystem::path& file);

/// What errors say about other extensions.
inline constexpr const char* kKnownFormats = "known are .off, .obj, .ply and .stl";

// One reader per format. Each throws IoError with the place in the file, and allocates no more than a small
// multiple of the file's size, whatever counts the file announces.
PolygonSoup read_off(const FileBytes& file);
PolygonSoup read_obj(const FileBytes& file);
PolygonSoup read_ply(const FileBytes& file);
PolygonSoup read_stl(const FileBytes& file);

/// True if the content can only be this format; formats without a signature (OBJ) have no such function.
bool looks_like_off(std::string_view bytes);
bool looks_like_ply(std::string_view bytes);
bool looks_like_ascii_stl(std::string_view bytes);
bool looks_like_binary_stl(std::string_view bytes);

/// Collects vertices and polygons while a file is read.
class SoupBuilder {
public:
    void reserve(std::size_t vertices, std::size_t polygons, std::size_t corners);
    void add_vertex(double x, double y, double z) {
        xyz_.push_back(x);
        xyz_.push_back(y);
        xyz_.push_back(z);
    }
    void add_corner(int vertex) { corners_.push_back(vertex); }
    void end_polygon() { start_.push_back(static_cast<int>(corners_.size())); }
    std::int64_t vertex_count() const { return static_cast<std::int64_t>(xyz_.size() / 3); }
    std::int64_t polygon_count() const { return static_cast<std::int64_t>(start_.size()) - 1; }
    PolygonSoup finish();

private:
    std::vector<double> xyz_;
    std::vector<int> start_{0}, corners_;
};

}  // namespace automorph
