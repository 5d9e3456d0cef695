#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>

#include "morph/mesh/errors.h"
#include "morph/mesh/readers.h"
#include "morph/mesh/write_file.h"

namespace automorph {

namespace {

void append_off(const Mesh& mesh, fmt::memory_buffer& out) {
    const auto to = std::back_inserter(out);
    fmt::format_to(to, "OFF\n{} {} 0\n", mesh.vertex_count(), mesh.triangle_count());
    for (const auto& p : mesh.V.rowwise()) fmt::format_to(to, "{} {} {}\n", p[0], p[1], p[2]);
    for (const auto& t : mesh.F.rowwise()) fmt::format_to(to, "3 {} {} {}\n", t[0], t[1], t[2]);
}

void append_obj(const Mesh& mesh, fmt::memory_buffer& out) {
    const auto to = std::back_inserter(out);
    for (const auto& p : mesh.V.rowwise()) fmt::format_to(to, "v {} {} {}\n", p[0], p[1], p[2]);
    for (const auto& t : mesh.F.rowwise()) fmt::format_to(to, "f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
}

/// Appends the bytes of a value, least significant first.
template <class T>
void append_little_endian(fmt::memory_buffer& out, T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if constexpr (std::endian::native == std::endian::big) std::reverse(raw, raw + sizeof(T));
    out.append(raw, raw + sizeof(T));
}

void append_ply(const Mesh& mesh, fmt::memory_buffer& out) {
    fmt::format_to(
        std::back_inserter(out),
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\n"
        "property double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.vertex_count(), mesh.triangle_count());
    for (Eigen::Index i = 0; i < mesh.V.size(); ++i) append_little_endian(out, mesh.V.data()[i]);
    for (const auto& t : mesh.F.rowwise()) {
        out.push_back(3);
        for (int k = 0; k < 3; ++k) append_little_endian(out, static_cast<std::int32_t>(t[k]));
    }
}

void append_stl(const Mesh& mesh, fmt::memory_buffer& out) {
    char header[80] = "binary STL";  // must not begin with "solid"
    out.append(header, header + sizeof(header));
    append_little_endian(out, static_cast<std::uint32_t>(mesh.triangle_count()));
    for (const auto& t : mesh.F.rowwise()) {
        const Eigen::RowVector3d a = mesh.V.row(t[0]), b = mesh.V.row(t[1]), c = mesh.V.row(t[2]);
        Eigen::RowVector3d n = (b - a).cross(c - a);
        const double length = n.norm();
        n = length > 0.0 && std::isfinite(length) ? Eigen::RowVector3d(n / length)
                                                  : Eigen::RowVector3d(0, 0, 0);
        for (const Eigen::RowVector3d& row : {n, a, b, c}) {
            for (int k = 0; k < 3; ++k) append_little_endian(out, static_cast<float>(row[k]));
        }
        append_little_endian(out, std::uint16_t{0});
    }
}

void check_coordinates(const std::string& name, const Mesh& mesh, double largest) {
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        for (int k = 0; k < 3; ++k) {
            if (!(std::abs(mesh.V(v, k)) <= largest)) {
                throw IoError(
                    fmt::format("{}: not written: vertex {} is ({} {} {}), which the format cannot hold",
                                name, v, mesh.V(v, 0), mesh.V(v, 1), mesh.V(v, 2)));
            }
        }
    }
}

}  // namespace

void write_mesh(const std::filesystem::path& file, const Mesh& mesh) {
    assert(mesh.F.size() == 0 || (mesh.F.minCoeff() >= 0 && mesh.F.maxCoeff() < mesh.vertex_count()));
    const MeshFormat format = format_of_name(file);
    if (format == MeshFormat::Unknown) {
        throw IoError(fmt::format("{}: not a known kind of mesh file; {}", file.string(), kKnownFormats));
    }
    check_coordinates(file.string(), mesh,
                      format == MeshFormat::Stl ? std::numeric_limits<float>::max() : kLargestCoordinate);
    fmt::memory_buffer out;
    if (format == MeshFormat::Off) append_off(mesh, out);
    if (format == MeshFormat::Obj) append_obj(mesh, out);
    if (format == MeshFormat::Ply) append_ply(mesh, out);
    if (format == MeshFormat::Stl) append_stl(mesh, out);
    write_file(file, {out.data(), out.size()});
}

PolygonSoup polygon_soup(const Mesh& mesh) {
    PolygonSoup soup;
    soup.V = mesh.V;
    soup.polygon_vertices.assign(mesh.F.data(), mesh.F.data() + mesh.F.size());
    soup.polygon_start.resize(static_cast<std::size_t>(mesh.triangle_count()) + 1);
    for (std::size_t f = 0; f < soup.polygon_start.size(); ++f)
        soup.polygon_start[f] = static_cast<int>(3 * f);
    return soup;
}

}  // namespace automorph
