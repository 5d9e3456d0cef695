#include <bit>
#include <cstring>
#include <limits>

#include "morph/mesh/io.h"
#include "tests/catch.h"
#include "tests/morph/mesh/shapes.h"

using namespace automorph;
using namespace automorph::testing;

namespace {

PolygonSoup stl(const std::string& text) {
    return parse_mesh(text, "a.stl");
}

std::string stl_error(const std::string& text) {
    return error_of<IoError>([&] { stl(text); });
}

std::string facet(const std::string& corners) {
    return "facet normal 0 0 1\n outer loop\n" + corners + " endloop\nendfacet\n";
}

const std::string kCorners = "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n";

void append(std::string& out, std::uint32_t bits) {
    for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(bits >> shift);
}

std::string binary_stl(std::string header, std::uint32_t announced, int facets) {
    header.resize(80, '\0');
    append(header, announced);
    for (int f = 0; f < facets; ++f) {
        for (int k = 0; k < 12; ++k)
            append(header, std::bit_cast<std::uint32_t>(static_cast<float>(100 * f + k)));
        header += "\x01\x02";
    }
    return header;
}

}  // namespace

TEST_CASE("text STL is read with several solids, names, any case and CR LF") {
    const std::string two = "solid one two\n" + facet(kCorners) + "endsolid one two\n\nsolid\n" +
                            facet(kCorners) + facet(kCorners) + "endsolid\n";
    PolygonSoup s = stl(two);
    CHECK(s.polygon_count() == 3);
    CHECK(s.V.rows() == 9);
    CHECK(s.V.row(7) == Eigen::RowVector3d(1, 0, 0));
    std::string shouted;
    for (const char c : two) {
        if (c == '\n') shouted += '\r';
        shouted += c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
    }
    CHECK(stl(shouted).V == s.V);
    CHECK(stl("solid\nendsolid\n").polygon_count() == 0);
    const std::string quad =
        "solid q\nfacet normal nan nan nan outer loop vertex 0 0 0 vertex 1 0 0 vertex 1 1 0 vertex 0 "
        "1 0 endloop endfacet\nendsolid";
    CHECK(stl(quad).polygon_vertices == std::vector<int>{0, 1, 2, 3});
}

TEST_CASE("binary STL is read, also if its header begins with 'solid'") {
    for (const char* header : {"", "binary", "solid made by a liar", "solid x\nfacet normal"}) {
        const PolygonSoup s = stl(binary_stl(header, 2, 2));
        REQUIRE(s.V.rows() == 6);
        CHECK(s.V.row(0) == Eigen::RowVector3d(3, 4, 5));
        CHECK(s.V.row(5) == Eigen::RowVector3d(109, 110, 111));
    }
    CHECK(stl(binary_stl("", 0, 0)).polygon_count() == 0);
}

TEST_CASE("what is wrong with an STL file is said with its place") {
    CHECK(
        contains(stl_error("solid\n" + facet("vertex 0 0 0\nvertex 1 nan 0\nvertex 0 1 0\n") + "endsolid\n"),
                 "a.stl:5: a corner of facet 0: expected a finite coordinate, found 'nan'"));
    CHECK(contains(stl_error("solid\n" + facet(kCorners)),
                   "a.stl:9: the file ends before 'endsolid', after 1 facets"));
    CHECK(
        contains(stl_error("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"), "ends within facet 0"));
    CHECK(contains(stl_error("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0\nendloop\n"),
                   "expected a number"));
    CHECK(contains(stl_error("solid\nfacet normal 0 0 1\nvertex 0 0 0\n"),
                   "a.stl:3: facet 0: expected 'outer'"));
    CHECK(contains(stl_error("solid\nfacet normal 0 0 1\nouter loop\nendfacet\n"),
                   "expected 'vertex' or 'endloop'"));
    CHECK(
        contains(stl_error("solid a\nsolid b\n"), "a.stl:2: expected 'facet' or 'endsolid', found 'solid'"));
    CHECK(contains(stl_error("hello"), "the file ends within the header"));
    CHECK(contains(stl_error(binary_stl("", 3, 2)),
                   "a.stl: byte 84: the header announces 3 facets of 50 bytes, but 100"));
    CHECK(contains(stl_error(binary_stl("solid", 4000000000U, 2)), "announces 4000000000 facets"));
    std::string bad = binary_stl("", 2, 2);
    const auto infinity = std::bit_cast<std::uint32_t>(std::numeric_limits<float>::infinity());
    std::memcpy(bad.data() + 84 + 50 + 12 + 4, &infinity, 4);
    CHECK(contains(stl_error(bad), "y of a corner of facet 1: expected a finite coordinate"));
}
