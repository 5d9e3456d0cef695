#include "morph/mesh/io.h"
#include "tests/catch.h"
#include "tests/morph/mesh/shapes.h"

using namespace automorph;
using namespace automorph::testing;

namespace {

PolygonSoup obj(const std::string& text) {
    return parse_mesh(text, "a.obj");
}

std::string obj_error(const std::string& text) {
    return error_of<IoError>([&] { obj(text); });
}

}  // namespace

TEST_CASE("OBJ vertices may carry weights and colours, and only their places are read") {
    const PolygonSoup s = obj("v 1 2 3\nv 4 5 6 1.0\nv 7 8 9 0.1 0.2 0.3\nf 1 2 3\n");
    REQUIRE(s.V.rows() == 3);
    CHECK(s.V.row(1) == Eigen::RowVector3d(4, 5, 6));
    CHECK(s.V.row(2) == Eigen::RowVector3d(7, 8, 9));
    CHECK(s.polygon_vertices == std::vector<int>{0, 1, 2});
}

TEST_CASE("OBJ corners are read in every notation") {
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    const std::vector<int> quad = {0, 1, 2, 3};
    for (const char* face : {"f 1 2 3 4", "f 1/1 2/2 3/3 4/4", "f 1//1 2//1 3//1 4//1",
                             "f 1/1/1 2/2/2 3/3/3 4/4/4", "f -4 -3 -2 -1", "f -4/-1 2//9 -2 4", "fo 1 2 3 4",
                             "  f\t1 2 3 4  # a quad", "f 1 2 \\\n 3 \\\r\n 4", "f 1 2 3\\\n 4"}) {
        CHECK(obj(vertices + face + "\n").polygon_vertices == quad);
        CHECK(obj(vertices + face).polygon_vertices == quad);
    }
}

TEST_CASE("OBJ groups, objects, materials, curves and unknown statements are skipped") {
    const PolygonSoup s =
        obj("# comment\nmtllib a.mtl\no first\ng left right\nv 0 0 0\nvn 0 0 1\nvt 0 0\nv 1 0 0\nv 0 1 "
            "0\nusemtl x\ns off\nf 1 2 "
            "3\no second\ng\nv 5 5 5\nv 6 5 5\nv 5 6 5\nf -3//1 -2//1 -1//1\nl 1 2\np 1\nvp 0.1\ncurv2 1 2 "
            "\\\n 3 4\nfrobnicate 7\n\n");
    CHECK(s.V.rows() == 6);
    CHECK(s.polygon_vertices == std::vector<int>{0, 1, 2, 3, 4, 5});
    CHECK(s.polygon_count() == 2);
}

TEST_CASE("an OBJ face may come before its vertices") {
    CHECK(obj("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").polygon_vertices == std::vector<int>{0, 1, 2});
    CHECK(contains(obj_error("v 0 0 0\nf 1 2 3\nf 1 2 4\nv 1 0 0\nv 0 1 0\n"),
                   "a.obj:3: vertex 4 in a face, but the file has 3 vertices"));
}

TEST_CASE("what is wrong with an OBJ file is said with its line") {
    const std::string v = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    CHECK(contains(obj_error(v + "f 0 1 2\n"), "a.obj:4: vertex 0 in a face; OBJ counts vertices from 1"));
    CHECK(contains(obj_error(v + "f -4 1 2\n"),
                   "a.obj:4: vertex -4 in a face, but only 3 vertices come before it"));
    CHECK(contains(obj_error(v + "f 1 2 9999999999\n"),
                   "a.obj:4: vertex 9999999999 in a face is out of range"));
    CHECK(contains(obj_error(v + "f 1 2 -9223372036854775808\n"), "a.obj:4: "));
    CHECK(contains(obj_error(v + "\n\nf 1,2,3\n"), "a.obj:6: expected a face corner such as"));
    CHECK(contains(obj_error(v + "f 1 2 a\n"), "found 'a'"));
    CHECK(contains(obj_error("v 0 0\nf 1 1 1\n"), "a.obj:1: vertex 1 has 2 coordinates instead of 3"));
    CHECK(contains(obj_error("v 0 0 nan\n"), "a.obj:1: a coordinate of vertex 1: expected a finite"));
    CHECK(contains(obj_error("v 0 0 \\\n 1e300\n"), "a.obj:2: a coordinate of vertex 1 is '1e300'"));
    CHECK(contains(obj_error("hello\nworld\n"), "no vertex in 2 statements"));
}
