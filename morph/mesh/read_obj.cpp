// Wavefront OBJ: the statements v and f; all others (normals, texture, groups, materials, lines) are skipped.
#include <fmt/format.h>

#include <limits>

#include "morph/mesh/readers.h"

namespace automorph {

namespace {

/// A face that names a vertex before it is defined; checked when all vertices are known.
struct ForwardReference {
    std::int64_t vertex;
    TextCursor where;
};

/// The vertex of a corner: "7", "7/1", "7//3", "7/1/3" or negative, counted back from the last vertex.
std::int64_t corner_vertex(const TextCursor& in, std::string_view corner, std::int64_t vertex_count) {
    const std::string_view text = corner.substr(0, corner.find('/'));
    std::int64_t index = 0;
    if (!parse_integer(text, index)) {
        in.fail(
            fmt::format("expected a face corner such as 7, 7/1, 7//3 or 7/1/3, found {}", quoted(corner)));
    }
    if (index == 0) in.fail("vertex 0 in a face; OBJ counts vertices from 1");
    if (index < -vertex_count) {
        in.fail(fmt::format("vertex {} in a face, but only {} vertices come before it", index, vertex_count));
    }
    return index > 0 ? index - 1 : vertex_count + index;
}

}  // namespace

PolygonSoup read_obj(const FileBytes& file) {
    TextCursor in(file, {'#', true});
    SoupBuilder soup;
    std::vector<ForwardReference> forward;
    std::int64_t statements = 0;
    for (; !in.at_end(); in.skip_line()) {
        const std::string_view statement = in.token_on_line();
        ++statements;
        if (statement == "v") {
            const std::int64_t v = soup.vertex_count() + 1;
            double xyz[3];
            for (int k = 0; k < 3; ++k) {
                const std::string_view number = in.token_on_line();
                if (number.empty()) in.fail(fmt::format("vertex {} has {} coordinates instead of 3", v, k));
                xyz[k] = in.to_coordinate(number, "a coordinate of vertex", v);
            }
            if (v > std::numeric_limits<int>::max()) in.fail("more vertices than an int can count");
            soup.add_vertex(xyz[0], xyz[1], xyz[2]);
        } else if (statement == "f" || statement == "fo") {
            for (std::string_view corner; !(corner = in.token_on_line()).empty();) {
                const std::int64_t vertex = corner_vertex(in, corner, soup.vertex_count());
                if (vertex > std::numeric_limits<int>::max()) {
                    in.fail(fmt::format("vertex {} in a face is out of range", vertex + 1));
                }
                if (vertex >= soup.vertex_count() && (forward.empty() || vertex > forward.back().vertex)) {
                    forward.push_back({vertex, in});
                }
                soup.add_corner(static_cast<int>(vertex));
            }
            soup.end_polygon();
        }
    }
    for (const ForwardReference& reference : forward) {
        if (reference.vertex >= soup.vertex_count()) {
            reference.where.fail(fmt::format("vertex {} in a face, but the file has {} vertices",
                                             reference.vertex + 1, soup.vertex_count()));
        }
    }
    if (soup.vertex_count() == 0) {
        in.fail(
            fmt::format("no vertex in {} statements: an OBJ file has lines such as 'v 0 0 0'", statements));
    }
    return soup.finish();
}

}  // namespace automorph
