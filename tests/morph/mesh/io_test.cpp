#include "morph/mesh/io.h"

#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "morph/mesh/admit.h"
#include "tests/catch.h"
#include "tests/morph/mesh/shapes.h"

using namespace automorph;
using namespace automorph::testing;
namespace fs = std::filesystem;

namespace {

/// A folder that goes away with the test.
struct Scratch {
    fs::path path = fs::temp_directory_path() / ("automorph-io-" + std::to_string(getpid()));
    Scratch() {
        fs::remove_all(path);
        fs::create_directories(path);
    }
    ~Scratch() { fs::remove_all(path); }
    int files() const { return static_cast<int>(std::distance(fs::directory_iterator(path), {})); }
};

/// The bits of doubles drawn over the whole range that readers accept.
Mesh wild_mesh() {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> mantissa(-1.0, 1.0), exponent(-320.0, 49.0);
    Mesh mesh;
    mesh.V.resize(300, 3);
    for (Eigen::Index i = 0; i < mesh.V.size(); ++i)
        mesh.V.data()[i] = mantissa(random) * std::pow(10.0, exponent(random));
    mesh.V.row(0) << 0.1, 1.0 / 3.0, 5e-324;
    mesh.V.row(1) << -0.0, 1e50, -1e50;
    mesh.V.row(2) << 123456789.123456789, 2.2250738585072014e-308, 1e23;
    mesh.F.resize(500, 3);
    for (Eigen::Index i = 0; i < mesh.F.size(); ++i) mesh.F.data()[i] = static_cast<int>(random() % 300);
    return mesh;
}

bool same_bits(const Points& a, const Points& b) {
    return a.rows() == b.rows() && std::memcmp(a.data(), b.data(), sizeof(double) * a.size()) == 0;
}

}  // namespace

TEST_CASE("OFF, OBJ and PLY give back every bit") {
    const Scratch scratch;
    const Mesh mesh = wild_mesh();
    for (const char* name : {"a.off", "a.obj", "a.ply", "A.PLY", "gesicht ä 面.off"}) {
        const fs::path file = scratch.path / name;
        write_mesh(file, mesh);
        const PolygonSoup back = read_mesh(file);
        CHECK(same_bits(back.V, mesh.V));
        CHECK(back.polygon_vertices == polygon_soup(mesh).polygon_vertices);
        CHECK(back.polygon_start == polygon_soup(mesh).polygon_start);
    }
    CHECK(scratch.files() == 5);
}

TEST_CASE("STL gives back single precision, and the mesh once it is admitted") {
    const Scratch scratch;
    const Mesh mesh = sphere(3);
    write_mesh(scratch.path / "s.stl", mesh);
    const PolygonSoup back = read_mesh(scratch.path / "s.stl");
    REQUIRE(back.V.rows() == 3 * mesh.F.rows());
    for (Eigen::Index c = 0; c < mesh.F.size(); ++c) {
        CHECK(back.V.row(c) == mesh.V.row(mesh.F.data()[c]).cast<float>().cast<double>());
    }
    const AdmittedMesh admitted = admit(back, "s.stl");
    CHECK(admitted.mesh.vertex_count() == mesh.vertex_count());
    CHECK(admitted.admitted.closed);
}

TEST_CASE("an existing file is replaced whole") {
    const Scratch scratch;
    write_mesh(scratch.path / "a.off", sphere(3));
    write_mesh(scratch.path / "a.off", sphere(1));
    CHECK(read_mesh(scratch.path / "a.off").V.rows() == sphere(1).V.rows());
}

TEST_CASE("what cannot be written is said, and nothing is left behind") {
    const Scratch scratch;
    const Mesh mesh = sphere(2);
    const auto error = [&](const fs::path& file, const Mesh& m) {
        return error_of<IoError>([&] { write_mesh(file, m); });
    };
    CHECK(contains(error(scratch.path / "a.xyz", mesh), "known are .off, .obj, .ply and .stl"));
    CHECK(contains(error(scratch.path / "a", mesh), "known are"));
    CHECK(contains(error(scratch.path / "missing" / "a.off", mesh),
                   "cannot be written: No such file or directory"));
    fs::create_directory(scratch.path / "folder.off");
    CHECK(contains(error(scratch.path / "folder.off", mesh), "cannot be written"));
    fs::remove(scratch.path / "folder.off");
    Mesh bad = mesh;
    bad.V(7, 1) = std::numeric_limits<double>::quiet_NaN();
    for (const char* name : {"a.off", "a.obj", "a.ply", "a.stl"}) {
        CHECK(contains(error(scratch.path / name, bad), "vertex 7"));
    }
    bad.V(7, 1) = 1e39;
    CHECK(contains(error(scratch.path / "a.stl", bad), "vertex 7"));
    CHECK(scratch.files() == 0);
}

TEST_CASE("a full disk is an error, and the file that was there stays") {
    const Scratch scratch;
    const fs::path file = scratch.path / "a.off";
    write_mesh(file, sphere(1));
    // A limit on file sizes fails in the same calls as a full disk.
    rlimit before{};
    REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{4096, before.rlim_max};
    REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
    const std::string error = error_of<IoError>([&] { write_mesh(file, sphere(5)); });
    REQUIRE(setrlimit(RLIMIT_FSIZE, &before) == 0);
    std::signal(SIGXFSZ, handler);
    CHECK(contains(error, "a.off: cannot be written: "));
    CHECK(scratch.files() == 1);
    CHECK(read_mesh(file).V.rows() == sphere(1).V.rows());
}

TEST_CASE("what cannot be read is said") {
    const Scratch scratch;
    const auto error = [&](const fs::path& file) { return error_of<IoError>([&] { read_mesh(file); }); };
    CHECK(contains(error(scratch.path / "none.off"), "none.off: no such file"));
    CHECK(contains(error(scratch.path / "a.gltf"), "not a known kind of mesh file"));
    fs::create_directory(scratch.path / "folder.ply");
    CHECK(contains(error(scratch.path / "folder.ply"), "not a regular file"));
    std::ofstream(scratch.path / "empty.obj").close();
    CHECK(contains(error(scratch.path / "empty.obj"), "the file is empty"));
    write_mesh(scratch.path / "a.ply", sphere(1));
    for (const char* name : {"b.off", "b.obj", "b.stl"}) {
        fs::rename(scratch.path / "a.ply", scratch.path / name);
        CHECK(contains(error(scratch.path / name), "the content is PLY; rename the file"));
        fs::rename(scratch.path / name, scratch.path / "a.ply");
    }
    write_mesh(scratch.path / "c.off", sphere(1));
    fs::rename(scratch.path / "c.off", scratch.path / "c.obj");
    CHECK(contains(error(scratch.path / "c.obj"), "the content is OFF"));
    CHECK(contains(error_of<IoError>([] { parse_mesh("\x1f\x8b\x08", "a.off"); }), "compressed"));
    CHECK(error_of<IoError>([] { parse_mesh("x", "two\nlines.off"); }).find('\n') == std::string::npos);
}

TEST_CASE("mesh files are known by their extension, in any case") {
    CHECK(is_mesh_file("a/b.OFF"));
    CHECK(is_mesh_file("b.obj"));
    CHECK(is_mesh_file(".b.Ply"));
    CHECK(is_mesh_file("b.stl"));
    CHECK_FALSE(is_mesh_file("off"));
    CHECK_FALSE(is_mesh_file("a.off.gz"));
    CHECK_FALSE(is_mesh_file(""));
}
