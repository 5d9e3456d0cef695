#include <algorithm>
#include <bit>
#include <cstring>

#include "morph/mesh/io.h"
#include "tests/catch.h"
#include "tests/morph/mesh/shapes.h"

using namespace automorph;
using namespace automorph::testing;

namespace {

PolygonSoup ply(const std::string& text) {
    return parse_mesh(text, "a.ply");
}

std::string ply_error(const std::string& text) {
    return error_of<IoError>([&] { ply(text); });
}

const std::string kTextHeader =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement "
    "face "
    "1\nproperty list uchar int vertex_indices\nend_header\n";

template <class T>
void append(std::string& out, T value, bool big) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (big != (std::endian::native == std::endian::big)) std::reverse(raw, raw + sizeof(T));
    out.append(raw, sizeof(T));
}

/// Vertices (short x, double y, extra list, float z), an unknown element, then faces with a flag before and
/// after.
template <class Count, class Index>
std::string binary_ply(bool big, const std::string& count, const std::string& index,
                       const std::string& line_end) {
    std::string header;
    for (const std::string& line :
         {std::string("ply"),
          std::string(big ? "format binary_big_endian 1.0" : "format binary_little_endian 1.0"),
          std::string("comment all sorts"), std::string("obj_info of things"),
          std::string("element vertex 4"), std::string("property short x"), std::string("property float64 y"),
          std::string("property list uint8 int16 tags"), std::string("property float z"),
          std::string("element camera 2"), std::string("property int id"),
          std::string("property list ushort double matrix"), std::string("element face 2"),
          std::string("property uchar flags"), "property list " + count + " " + index + " vertex_index",
          std::string("property float quality"), std::string("element edge 0"),
          std::string("property int vertex1"), std::string("end_header")}) {
        header += line + line_end;
    }
    std::string out = header;
    for (int v = 0; v < 4; ++v) {
        append(out, static_cast<std::int16_t>(v), big);
        append(out, 10.0 * v, big);
        append(out, static_cast<std::uint8_t>(v), big);
        for (int k = 0; k < v; ++k) append(out, static_cast<std::int16_t>(-1), big);
        append(out, static_cast<float>(-v), big);
    }
    for (int c = 0; c < 2; ++c) {
        append(out, c, big);
        append(out, static_cast<std::uint16_t>(2), big);
        for (int k = 0; k < 2; ++k) append(out, 1e300, big);
    }
    for (const std::vector<int>& face : {std::vector<int>{0, 1, 2}, std::vector<int>{3, 2, 1, 0}}) {
        append(out, std::uint8_t{10}, big);
        append(out, static_cast<Count>(face.size()), big);
        for (const int v : face) append(out, static_cast<Index>(v), big);
        append(out, 0.5F, big);
    }
    return out;
}

}  // namespace

TEST_CASE("binary PLY of either byte order is read with any types, extra properties and elements") {
    for (const bool big : {false, true}) {
        check_triangle_and_quad(ply(binary_ply<std::uint8_t, int>(big, "uchar", "int", "\n")));
        check_triangle_and_quad(ply(binary_ply<int, std::uint16_t>(big, "int32", "uint16", "\n")));
        check_triangle_and_quad(ply(binary_ply<std::int8_t, std::uint8_t>(big, "char", "uint8", "\r\n")));
        check_triangle_and_quad(ply(binary_ply<std::uint32_t, double>(big, "uint", "double", "\n")));
    }
}

TEST_CASE("a binary PLY body may begin with a byte that looks like a line end") {
    for (const std::string line_end : {"\n", "\r\n", "\r"}) {
        std::string text;
        for (const char* line : {"ply", "format binary_little_endian 1.0", "element vertex 1",
                                 "property uchar x", "property uchar y", "property uchar z", "end_header"}) {
            text += line + line_end;
        }
        const PolygonSoup s = ply(text + "\n\r\n");
        REQUIRE(s.V.rows() == 1);
        CHECK(s.V.row(0) == Eigen::RowVector3d(10, 13, 10));
    }
}

TEST_CASE("every cut of a binary PLY file is refused at a byte or header line") {
    const std::string whole = binary_ply<std::uint8_t, int>(false, "uchar", "int", "\n");
    for (std::size_t length = 1; length < whole.size(); ++length) {
        const std::string error = ply_error(whole.substr(0, length));
        CHECK((contains(error, "a.ply: byte ") || contains(error, "a.ply:")));
    }
}

TEST_CASE("text PLY is read with extra properties, comments, elements in any order and CR LF") {
    CHECK(ply(kTextHeader + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").polygon_vertices == std::vector<int>{0, 1, 2});
    const PolygonSoup s =
        ply("ply\r\nformat ascii 1.0\r\ncomment x\r\nelement face 2\r\nproperty list uchar uint "
            "vertex_index\r\nproperty "
            "uchar red\r\nelement vertex 4\r\nproperty float nx\r\nproperty double z\r\nproperty double "
            "x\r\nproperty "
            "list int float w\r\nproperty double y\r\nend_header\r\n3 0 1 2 255\r\n4 3 2 1 0 0\r\n"
            "9 0 0 0 0\r\n9 -1 1 2 7 8 10\r\n9 -2 2 0 20\r\n9 -3 3 1 nan 30\r\n");
    check_triangle_and_quad(s);
}

TEST_CASE("a PLY file without faces is a point cloud") {
    const PolygonSoup s =
        ply("ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nproperty int y\nproperty int "
            "z\nend_header\n1 2 3\n");
    CHECK(s.V.rows() == 1);
    CHECK(s.polygon_count() == 0);
}

TEST_CASE("what is wrong with a PLY file is said with its place") {
    const auto header = [](const std::string& body) {
        return "ply\nformat ascii 1.0\n" + body + "end_header\n";
    };
    const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
    CHECK(contains(ply_error(kTextHeader + "0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n"),
                   "a.ply:12: y of vertex 2: expected a finite coordinate, found nan"));
    CHECK(contains(ply_error(kTextHeader + "0 0 0\n1 0 0\n0 1e300 0\n3 0 1 2\n"), "a.ply:12: y of vertex 2"));
    CHECK(contains(ply_error(kTextHeader + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
                   "a.ply:13: face 0 uses vertex 3, but the file has vertices 0 to 2"));
    CHECK(contains(ply_error(kTextHeader + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n"), "face 0 uses vertex -1"));
    CHECK(contains(ply_error(kTextHeader + "0 0 0\n1 0 0\n0 1 0\n3 0 1 0.5\n"), "face 0 uses vertex 0.5"));
    CHECK(contains(ply_error(kTextHeader + "0 0 0\n1 0 0\n0 1 0\n3 0 1 nan\n"), "face 0 uses vertex nan"));
    CHECK(contains(ply_error(kTextHeader + "0 0 0\n1 0 0\n0 1 0\n3000 0 1 2\n"),
                   "face 0: a list of 3000 values"));
    CHECK(contains(ply_error(kTextHeader + "0 0 0\n1 0 0\n0 1 0\n3 0 1   "), "the file ends within face 0"));
    CHECK(contains(ply_error(kTextHeader + "0 0 0\n1 0 x\n0 1 0\n3 0 1 2\n"),
                   "vertex 1: expected a number, found 'x'"));
    CHECK(contains(ply_error(kTextHeader + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n7\n"),
                   "data follow the last element"));
    CHECK(contains(ply_error(header("element vertex 10000000\n" + xyz) + "0 0 0\n"),
                   "announces 10000000 entries of element 'vertex'"));
    CHECK(contains(ply_error(header("element vertex 9223372036854775807\n" + xyz)),
                   "announces 9223372036854775807"));
    CHECK(contains(ply_error(header("element vertex -1\n" + xyz)),
                   "a.ply:3: element 'vertex': expected how many"));
    CHECK(contains(ply_error(header("element vertex 1\nproperty float x\nproperty float y\n") + "0 0"),
                   "lacks one of"));
    CHECK(contains(ply_error(header("element vertex 99999999\n")), "lacks one of the properties x, y, z"));
    CHECK(contains(
        ply_error(header("element vertex 1\n" + xyz + "element face 1\nproperty list uchar int corners\n") +
                  "0 0 0\n3 0 0 0\n"),
        "lacks the list property vertex_indices"));
    CHECK(contains(ply_error(header("element vertex 1\nproperty half x\n")), "a.ply:4: expected a type"));
    CHECK(contains(ply_error(header("element vertex 1\nproperty list float int x\n")),
                   "must be an integer type"));
    CHECK(contains(ply_error(header("property float x\n")), "a property before the first element"));
    CHECK(contains(ply_error(header("element vertex 1\n" + xyz + "element vertex 1\n" + xyz)),
                   "a second element"));
    CHECK(contains(ply_error(header("nonsense\n")), "a.ply:3: expected a header line"));
    CHECK(contains(ply_error(header("")), "no element 'vertex'"));
    CHECK(contains(ply_error("ply\nelement vertex 0\n" + xyz + "end_header\n"), "no 'format' line"));
    CHECK(contains(ply_error("ply\nformat binary 1.0\n"), "a.ply:2: expected ascii"));
    CHECK(contains(ply_error("ply\nformat ascii 1.0\n"), "ends within the header"));
    CHECK(contains(ply_error("plywood\n"), "starts with the word 'ply'"));
    // An element without properties takes no bytes, however many there are.
    CHECK(ply(header("element ghost 9223372036854775807\nelement vertex 0\n" + xyz)).V.rows() == 0);
}
