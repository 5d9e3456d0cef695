#include <fmt/format.h>

#include <bit>

#include "morph/mesh/io.h"
#include "tests/catch.h"
#include "tests/morph/mesh/shapes.h"

using namespace automorph;
using namespace automorph::testing;

namespace {

PolygonSoup off(const std::string& text) {
    return parse_mesh(text, "a.off");
}

std::string off_error(const std::string& text) {
    return error_of<IoError>([&] { off(text); });
}

void append_big_endian(std::string& out, std::uint32_t bits) {
    for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(bits >> shift);
}

}  // namespace

TEST_CASE("OFF is read in all its spellings") {
    const std::string vertices = "0 0 0\n1 10 -1\n2 20 -2\n3 30 -3\n", faces = "3 0 1 2\n4 3 2 1 0\n";
    SECTION("plain") {
        check_triangle_and_quad(off("OFF\n4 2 0\n" + vertices + faces));
    }
    SECTION("counts on the keyword's line") {
        check_triangle_and_quad(off("OFF 4 2 5\n" + vertices + faces));
    }
    SECTION("no edge count") {
        check_triangle_and_quad(off("OFF\n4 2\n" + vertices + faces));
    }
    SECTION("a count per line") {
        check_triangle_and_quad(off("OFF\n4\n2\n0\n" + vertices + faces));
    }
    SECTION("no keyword") {
        check_triangle_and_quad(off("4 2 0\n" + vertices + faces));
    }
    SECTION("comments and blank lines anywhere") {
        check_triangle_and_quad(off(
            "# made by hand\n\nOFF # really\n# counts\n4 2 0# here\n\n0 0 0 # first\n1 10 -1\n#\n2 20 -2\n3 "
            "30 -3\n\n3 0 1 2\n#between\n4 3 2 1 0\n# end"));
    }
    SECTION("CR LF") {
        check_triangle_and_quad(
            off("OFF\r\n4 2 0\r\n0 0 0\r\n1 10 -1\r\n2 20 -2\r\n3 30 -3\r\n3 0 1 2\r\n4 3 2 1 0\r\n"));
    }
    SECTION("CR alone") {
        check_triangle_and_quad(off("OFF\r4 2 0\r0 0 0\r1 10 -1\r2 20 -2\r3 30 -3\r3 0 1 2\r4 3 2 1 0"));
    }
    SECTION("byte order mark, tabs, plus signs, exponents") {
        check_triangle_and_quad(
            off("\xEF\xBB\xBFOFF\n4 2 0\n0\t0\t0\n+1 1e1 -1.0E0\n2 +20. -2\n.3e+1 30 -3\n" + faces));
    }
    SECTION("everything on one line") {
        check_triangle_and_quad(off("OFF 4 2 0 0 0 0 1 10 -1 2 20 -2 3 30 -3 3 0 1 2 4 3 2 1 0"));
    }
    SECTION("a vertex over several lines") {
        check_triangle_and_quad(off("OFF\n4 2 0\n0\n0 0\n1 10\n-1 2 20 -2\n3 30 -3\n" + faces));
    }
    SECTION("face colours") {
        check_triangle_and_quad(
            off("OFF\n4 2 0\n" + vertices + "3 0 1 2 255 0 0\n4 3 2 1 0 0.5 0.5 0.5 1\n"));
    }
    SECTION("vertex colours of four numbers") {
        check_triangle_and_quad(
            off("COFF\n4 2 0\n0 0 0 1 0 0 1\n1 10 -1 1 0 0 1\n2 20 -2 1 0 0 1\n3 30 -3 1 0 0 1\n" + faces));
    }
    SECTION("vertex colours of three numbers") {
        check_triangle_and_quad(
            off("COFF\n4 2 0\n0 0 0 255 0 0\n1 10 -1 255 0 0\n2 20 -2 255 0 0\n3 30 -3 255 0 0\n" + faces));
    }
    SECTION("vertex colours that the keyword does not announce") {
        check_triangle_and_quad(
            off("OFF\n4 2 0\n0 0 0 255 0 0\n1 10 -1 255 0 0\n2 20 -2 255 0 0\n3 30 -3 255 0 0\n" + faces));
    }
    SECTION("texture, colours and normals without line ends") {
        std::string text = "STCNOFF 4 2 0";
        for (int v = 0; v < 4; ++v) {
            text += fmt::format(" {} {} {} 0 0 1  9 9 9 9  0.5 0.5", v, 10 * v, -v);
        }
        check_triangle_and_quad(off(text + " 3 0 1 2\n4 3 2 1 0\n"));
    }
}

TEST_CASE("binary OFF is read, big endian, with what else its vertices and faces hold") {
    std::string data = "NOFF BINARY\n";
    for (const std::uint32_t count : {4U, 2U, 0U}) append_big_endian(data, count);
    for (int v = 0; v < 4; ++v) {
        for (const int x : {v, 10 * v, -v, 0, 0, 1}) {
            append_big_endian(data, std::bit_cast<std::uint32_t>(static_cast<float>(x)));
        }
    }
    for (const std::uint32_t x : {3U, 0U, 1U, 2U, 0U}) append_big_endian(data, x);
    for (const std::uint32_t x : {4U, 3U, 2U, 1U, 0U, 2U, 7U, 7U}) append_big_endian(data, x);
    check_triangle_and_quad(off(data));
    for (std::size_t length = 12; length < data.size(); ++length) {
        CHECK(contains(off_error(data.substr(0, length)), "a.off: byte "));
    }
}

TEST_CASE("what is wrong with an OFF file is said with its line") {
    const std::string three = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
    CHECK(off_error("OFF\n3 1 0\n0 0 0\n1 x 0\n0 1 0\n3 0 1 2\n") ==
          "a.off:4: y of vertex 1: expected a number, found 'x'");
    CHECK(contains(off_error("OFF\n3 1 0\n0 0 0\nnan 0 0\n0 1 0\n3 0 1 2\n"),
                   "a.off:4: x of vertex 1: expected a finite"));
    CHECK(contains(off_error("OFF\n3 1 0\n0 0 0\n1 0 -inf\n0 1 0\n3 0 1 2\n"),
                   "a.off:4: z of vertex 1: expected a finite"));
    CHECK(contains(off_error("OFF\n3 1 0\n0 0 0\n1 0 1e300\n0 1 0\n3 0 1 2\n"),
                   "a.off:4: z of vertex 1 is '1e300'"));
    CHECK(contains(off_error("OFF\n3 1 0\n0 0 0\n1 0 1e999\n0 1 0\n3 0 1 2\n"), "a.off:4: z of vertex 1"));
    CHECK(contains(off_error(three + "3 0 1 3\n"), "a.off:6: face 0 uses vertex 3"));
    CHECK(contains(off_error(three + "3 0 -1 2\n"), "a.off:6: face 0 uses vertex -1"));
    CHECK(contains(off_error(three + "-3 0 1 2\n"), "a.off:6: face 0 announces -3"));
    CHECK(contains(off_error(three + "99 0 1 2\n"), "a.off:6: face 0 announces 99 corners"));
    CHECK(contains(off_error(three + "3 0 1.5 2\n"), "expected an integer, found '1.5'"));
    CHECK(contains(off_error("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
                   "the file ends where the number of corners of face 1"));
    CHECK(contains(off_error(three + "3 0 1 2\n3 2 1 0\n"), "a.off:7: the header announces 1 faces"));
    CHECK(contains(off_error("OFF\n-3 1 0\n0 0 0\n1 0 0\n0 1 0\n"),
                   "a.off:2: the header announces -3 vertices"));
    CHECK(contains(off_error("OFF\n10000000 20000000 0\n0 0 0\n1 0 0\n0 1 0\n"),
                   "announces 10000000 vertices, more than the"));
    CHECK(contains(off_error("OFF\n3 20000000 0\n0 0 0\n1 0 0\n0 1 0\n"),
                   "announces 20000000 faces, more than the"));
    CHECK(contains(off_error("OFF\n99999999999999999999 1 0\n"),
                   "the number of vertices: expected an integer"));
    CHECK(contains(off_error("OFF"), "the file ends where the number of vertices"));
    CHECK(contains(off_error("4OFF\n1 0 0\n0 0 0 1\n"), "other than three dimensions"));
    CHECK(contains(off_error("# nothing\n"), "no data"));
    CHECK(contains(off_error("hello\n"), "a.off:1: expected the word OFF"));
    CHECK(contains(off_error("BOFF 1 1 1\n"), "expected the word OFF"));
}
