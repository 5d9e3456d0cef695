// STL: a bag of triangles, text or binary. Corners are not shared; admit() merges them.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "morph/mesh/binary_cursor.h"
#include "morph/mesh/readers.h"

namespace automorph {

namespace {

constexpr std::size_t kHeaderBytes = 80, kFacetBytes = 50;

bool same_word(std::string_view token, std::string_view word) {
    return token.size() == word.size() &&
           std::equal(token.begin(), token.end(), word.begin(), [](char a, char b) {
               return (a >= 'A' && a <= 'Z' ? static_cast<char>(a + 32) : a) == b;
           });
}

std::uint32_t announced_facets(std::string_view bytes) {
    const FileBytes file{bytes, {}};
    return BinaryCursor(file, kHeaderBytes, std::endian::little).value<std::uint32_t>("facet count", 0);
}

void expect(TextCursor& in, std::string_view word, std::int64_t facet) {
    const std::string_view found = in.token();
    if (same_word(found, word)) return;
    if (found.empty()) in.fail(fmt::format("the file ends within facet {}, before '{}'", facet, word));
    in.fail(fmt::format("facet {}: expected '{}', found {}", facet, word, quoted(found)));
}

void read_facet(TextCursor& in, SoupBuilder& soup) {
    const std::int64_t facet = soup.polygon_count();
    expect(in, "normal", facet);
    for (int k = 0; k < 3; ++k) in.token();  // often wrong or nan; the corners say it all
    expect(in, "outer", facet);
    expect(in, "loop", facet);
    for (std::string_view word; !same_word(word = in.token(), "endloop");) {
        if (word.empty()) in.fail(fmt::format("the file ends within facet {}", facet));
        if (!same_word(word, "vertex")) {
            in.fail(fmt::format("facet {}: expected 'vertex' or 'endloop', found {}", facet, quoted(word)));
        }
        const double x = in.coordinate("a corner of facet", facet),
                     y = in.coordinate("a corner of facet", facet),
                     z = in.coordinate("a corner of facet", facet);
        if (soup.vertex_count() == std::numeric_limits<int>::max())
            in.fail("more corners than an int can count");
        soup.add_corner(static_cast<int>(soup.vertex_count()));
        soup.add_vertex(x, y, z);
    }
    expect(in, "endfacet", facet);
    soup.end_polygon();
}

PolygonSoup read_text(const FileBytes& file) {
    TextCursor in(file, {});
    SoupBuilder soup;
    bool inside = false;
    for (std::string_view word; !(word = in.token()).empty();) {
        if (inside && same_word(word, "facet")) {
            read_facet(in, soup);
        } else if (!inside && same_word(word, "solid")) {
            inside = true;
            in.skip_line();
        } else if (inside && same_word(word, "endsolid")) {
            inside = false;
            in.skip_line();
        } else {
            in.fail(fmt::format("expected {}, found {}", inside ? "'facet' or 'endsolid'" : "'solid'",
                                quoted(word)));
        }
    }
    if (inside)
        in.fail(fmt::format("the file ends before 'endsolid', after {} facets", soup.polygon_count()));
    return soup.finish();
}

PolygonSoup read_binary(const FileBytes& file) {
    if (file.bytes.size() < kHeaderBytes + 4) {
        throw IoError(
            fmt::format("{}: byte {}: the file ends within the header; a binary STL file has at least {} "
                        "bytes, a text one starts with 'solid'",
                        file.name, file.bytes.size(), kHeaderBytes + 4));
    }
    const std::size_t facets = announced_facets(file.bytes);
    BinaryCursor in(file, kHeaderBytes + 4, std::endian::little);
    if (in.bytes_left() != facets * kFacetBytes) {
        in.fail(fmt::format(
            "the header announces {} facets of {} bytes, but {} bytes follow: the file is cut off, "
            "damaged, or not STL",
            facets, kFacetBytes, in.bytes_left()));
    }
    if (facets > std::numeric_limits<int>::max() / 3) in.fail("more corners than an int can count");
    SoupBuilder soup;
    soup.reserve(3 * facets, facets, 3 * facets);
    for (std::size_t f = 0; f < facets; ++f) {
        in.skip(12);  // the normal
        for (int k = 0; k < 3; ++k) {
            const auto facet = static_cast<std::int64_t>(f);
            const double x = in.coordinate<float>("x of a corner of facet", facet),
                         y = in.coordinate<float>("y of a corner of facet", facet),
                         z = in.coordinate<float>("z of a corner of facet", facet);
            soup.add_corner(static_cast<int>(soup.vertex_count()));
            soup.add_vertex(x, y, z);
        }
        soup.end_polygon();
        in.skip(2);  // attributes
    }
    return soup.finish();
}

}  // namespace

bool looks_like_binary_stl(std::string_view bytes) {
    // The text form cannot have this length but by chance: its 81st to 84th byte would have to spell it.
    return bytes.size() >= kHeaderBytes + 4 &&
           bytes.size() - kHeaderBytes - 4 == announced_facets(bytes) * kFacetBytes;
}

bool looks_like_ascii_stl(std::string_view bytes) {
    const FileBytes file{bytes.substr(0, 4096), {}};
    TextCursor in(file, {});
    if (!same_word(in.token(), "solid")) return false;
    in.skip_line();
    const std::string_view next = in.token();
    return next.empty() || same_word(next, "facet") || same_word(next, "endsolid");
}

PolygonSoup read_stl(const FileBytes& file) {
    if (!looks_like_binary_stl(file.bytes)) {
        TextCursor in(file, {});
        const std::string_view word = in.token();
        // Binary headers may begin with "solid" too, but then hold bytes that no text has.
        const bool text = file.bytes.substr(0, kHeaderBytes + 4).find('\0') == std::string_view::npos;
        if (looks_like_ascii_stl(file.bytes) || (text && same_word(word, "solid"))) return read_text(file);
    }
    return read_binary(file);
}

}  // namespace automorph
