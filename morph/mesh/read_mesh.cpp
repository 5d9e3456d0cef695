#include <fmt/format.h>

#include <fstream>
#include <new>

#include "morph/mesh/errors.h"
#include "morph/mesh/readers.h"

namespace automorph {

namespace {

const char* name_of(MeshFormat format) {
    switch (format) {
        case MeshFormat::Off:
            return "OFF";
        case MeshFormat::Obj:
            return "OBJ";
        case MeshFormat::Ply:
            return "PLY";
        case MeshFormat::Stl:
            return "STL";
        case MeshFormat::Unknown:
            break;
    }
    return "unknown";
}

/// What the content says it is; OBJ has no signature.
MeshFormat format_of_content(std::string_view bytes) {
    if (looks_like_ply(bytes)) return MeshFormat::Ply;
    if (looks_like_off(bytes)) return MeshFormat::Off;
    if (looks_like_binary_stl(bytes) || looks_like_ascii_stl(bytes)) return MeshFormat::Stl;
    return MeshFormat::Unknown;
}

std::string printable(std::string name) {
    for (char& c : name) {
        if (static_cast<unsigned char>(c) < 0x20) c = '?';
    }
    return name;
}

std::string read_bytes(const std::filesystem::path& file, const std::string& name) {
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (status.type() == std::filesystem::file_type::not_found) throw IoError(name + ": no such file");
    if (error) throw IoError(fmt::format("{}: cannot be read: {}", name, error.message()));
    if (status.type() != std::filesystem::file_type::regular) throw IoError(name + ": not a regular file");
    const auto size = std::filesystem::file_size(file, error);
    std::ifstream in(file, std::ios::binary);
    if (!in || error) throw IoError(name + ": cannot be opened for reading; check its permissions");
    std::string bytes(size, '\0');
    in.read(bytes.data(), static_cast<std::streamsize>(size));
    if (static_cast<std::uintmax_t>(in.gcount()) != size) {
        throw IoError(fmt::format("{}: only {} of {} bytes could be read", name, in.gcount(), size));
    }
    return bytes;
}

}  // namespace

void SoupBuilder::reserve(std::size_t vertices, std::size_t polygons, std::size_t corners) {
    xyz_.reserve(3 * vertices);
    start_.reserve(polygons + 1);
    corners_.reserve(corners);
}

PolygonSoup SoupBuilder::finish() {
    PolygonSoup soup;
    soup.V = Eigen::Map<const Points>(xyz_.data(), static_cast<Eigen::Index>(xyz_.size() / 3), 3);
    soup.polygon_start = std::move(start_);
    soup.polygon_vertices = std::move(corners_);
    return soup;
}

MeshFormat format_of_name(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
    if (extension == ".off") return MeshFormat::Off;
    if (extension == ".obj") return MeshFormat::Obj;
    if (extension == ".ply") return MeshFormat::Ply;
    if (extension == ".stl") return MeshFormat::Stl;
    return MeshFormat::Unknown;
}

bool is_mesh_file(const std::filesystem::path& file) {
    return format_of_name(file) != MeshFormat::Unknown;
}

PolygonSoup parse_mesh(std::string_view bytes, const std::string& name) {
    const FileBytes file{bytes, printable(name)};
    const MeshFormat format = format_of_name(name), content = format_of_content(bytes);
    if (format == MeshFormat::Unknown) {
        throw IoError(fmt::format("{}: not a known kind of mesh file; {}", file.name, kKnownFormats));
    }
    if (bytes.empty()) throw IoError(fmt::format("{}:1: the file is empty", file.name));
    if (content != MeshFormat::Unknown && content != format) {
        throw IoError(fmt::format("{}:1: the name says {}, the content is {}; rename the file", file.name,
                                  name_of(format), name_of(content)));
    }
    if (bytes.starts_with("\x1f\x8b") || bytes.starts_with("PK\x03\x04")) {
        throw IoError(fmt::format("{}: byte 0: a compressed file; unpack it first", file.name));
    }
    try {
        switch (format) {
            case MeshFormat::Off:
                return read_off(file);
            case MeshFormat::Obj:
                return read_obj(file);
            case MeshFormat::Ply:
                return read_ply(file);
            default:
                return read_stl(file);
        }
    } catch (const std::bad_alloc&) {
        throw IoError(fmt::format("{}: {} bytes of mesh do not fit into memory", file.name, bytes.size()));
    }
}

PolygonSoup read_mesh(const std::filesystem::path& file) {
    const std::string name = printable(file.string());
    if (!is_mesh_file(file))
        throw IoError(fmt::format("{}: not a known kind of mesh file; {}", name, kKnownFormats));
    return parse_mesh(read_bytes(file, name), name);
}

}  // namespace automorph
