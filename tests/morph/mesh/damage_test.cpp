// Damaged files: whatever the bytes, a reader gives a soup or one line of error, in memory bounded by the
// file's size, and admit() gives a valid mesh or one line of error.
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "morph/mesh/admit.h"
#include "morph/mesh/connectivity.h"
#include "tests/catch.h"
#include "tests/morph/mesh/allocation_meter.h"
#include "tests/morph/mesh/shapes.h"

using namespace automorph;
using namespace automorph::testing;

namespace {

// A byte of file may cost this much memory while it is read: the shortest OBJ face statement, three bytes,
// takes 4 bytes of soup, doubled while vectors grow; a PLY property line of 15 bytes takes 40.
constexpr std::size_t kBytesPerByte = 64;
constexpr std::size_t kBytesOnTop = 64 * 1024;  // an exception, its message, the table of formats

struct Outcome {
    int soups = 0, read_errors = 0, admitted = 0, refused = 0;
};

bool one_line(const std::string& message) {
    return !message.empty() && message.size() < 1000 && message.find('\n') == std::string::npos;
}

/// Eigen's memory does not come from operator new; its largest matrix is bounded through the vertex count.
void check_soup(const PolygonSoup& soup, std::size_t file_size) {
    REQUIRE(static_cast<std::size_t>(soup.V.rows()) <= file_size);
    REQUIRE(soup.V.allFinite());
    REQUIRE(soup.polygon_start.front() == 0);
    REQUIRE(soup.polygon_start.back() == static_cast<int>(soup.polygon_vertices.size()));
    REQUIRE(std::is_sorted(soup.polygon_start.begin(), soup.polygon_start.end()));
    for (const int v : soup.polygon_vertices) REQUIRE((v >= 0 && v < soup.V.rows()));
}

void try_bytes(const std::string& bytes, const std::string& name, Outcome& outcome) {
    PolygonSoup soup;
    {
        const AllocationMeter meter;
        try {
            soup = parse_mesh(bytes, name);
            ++outcome.soups;
        } catch (const IoError& error) {
            ++outcome.read_errors;
            REQUIRE(one_line(error.what()));
            REQUIRE(std::string(error.what()).rfind(name, 0) == 0);
        }
        REQUIRE(meter.peak() <= kBytesPerByte * bytes.size() + kBytesOnTop);
    }
    check_soup(soup, bytes.size());
    inspect(soup);
    try {
        const AdmittedMesh admitted = admit(soup, name);
        ++outcome.admitted;
        REQUIRE(admitted.admitted.genus == 0);
        REQUIRE(admitted.admitted.components == 1);
        const Connectivity topology = connectivity(admitted.mesh.F, admitted.mesh.vertex_count());
        REQUIRE(euler_characteristic(topology) == 2 - admitted.admitted.boundary_loops);
    } catch (const InvalidMesh& error) {
        ++outcome.refused;
        REQUIRE(one_line(error.what()));
        REQUIRE(std::string(error.what()).rfind(name, 0) == 0);
    }
}

std::string text_off(const PolygonSoup& s) {
    std::ostringstream out;
    out.precision(17);
    out << "OFF\n# a comment\n" << s.V.rows() << ' ' << s.polygon_count() << " 0\n";
    for (const auto& p : s.V.rowwise()) out << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
    for (int p = 0; p < s.polygon_count(); ++p) {
        out << s.polygon_start[p + 1] - s.polygon_start[p];
        for (int i = s.polygon_start[p]; i < s.polygon_start[p + 1]; ++i) out << ' ' << s.polygon_vertices[i];
        out << '\n';
    }
    return out.str();
}

std::string text_obj(const PolygonSoup& s) {
    std::ostringstream out;
    out << "o thing\nvt 0 0\n";
    for (const auto& p : s.V.rowwise()) out << "v " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
    for (int p = 0; p < s.polygon_count(); ++p) {
        out << 'f';
        for (int i = s.polygon_start[p]; i < s.polygon_start[p + 1]; ++i) {
            const int v = s.polygon_vertices[i];
            if (i % 2 == 0) {
                out << ' ' << v + 1 << "/1";
            } else {
                out << ' ' << v - s.V.rows() << "//1 \\\n";
            }
        }
        out << '\n';
    }
    return out.str();
}

std::string text_ply(const PolygonSoup& s) {
    std::ostringstream out;
    out << "ply\nformat ascii 1.0\ncomment c\nelement vertex " << s.V.rows()
        << "\nproperty float x\nproperty float y\nproperty float z\nproperty list uchar int tags\nelement "
           "face "
        << s.polygon_count() << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const auto& p : s.V.rowwise()) out << p[0] << ' ' << p[1] << ' ' << p[2] << " 2 7 7\n";
    for (int p = 0; p < s.polygon_count(); ++p) {
        out << s.polygon_start[p + 1] - s.polygon_start[p];
        for (int i = s.polygon_start[p]; i < s.polygon_start[p + 1]; ++i) out << ' ' << s.polygon_vertices[i];
        out << '\n';
    }
    return out.str();
}

std::string text_stl(const PolygonSoup& s) {
    std::ostringstream out;
    out << "solid thing\n";
    for (int p = 0; p < s.polygon_count(); ++p) {
        out << "facet normal 0 0 1\nouter loop\n";
        for (int i = s.polygon_start[p]; i < s.polygon_start[p + 1]; ++i) {
            const auto v = s.V.row(s.polygon_vertices[i]);
            out << "vertex " << v[0] << ' ' << v[1] << ' ' << v[2] << '\n';
        }
        out << "endloop\nendfacet\n";
    }
    out << "endsolid thing\n";
    return out.str();
}

/// What write_mesh makes of a mesh.
std::string written(const Mesh& mesh, const std::string& extension) {
    const auto file = std::filesystem::temp_directory_path() /
                      ("automorph-damage-" + std::to_string(::getpid()) + extension);
    write_mesh(file, mesh);
    std::ifstream in(file, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(in)), {});
    std::filesystem::remove(file);
    return bytes;
}

std::string binary_big_endian_ply() {
    std::string out =
        "ply\nformat binary_big_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
        "float "
        "z\nproperty list int uchar tags\nelement face 4\nproperty list uchar int vertex_index\nend_header\n";
    const auto append = [&](std::uint32_t bits) {
        for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(bits >> shift);
    };
    const PolygonSoup s = tetrahedron();
    for (const auto& p : s.V.rowwise()) {
        for (int k = 0; k < 3; ++k) append(std::bit_cast<std::uint32_t>(static_cast<float>(p[k])));
        append(1);
        out += 'x';
    }
    for (std::size_t i = 0; i < s.polygon_vertices.size(); ++i) {
        if (i % 3 == 0) out += '\x03';
        append(static_cast<std::uint32_t>(s.polygon_vertices[i]));
    }
    return out;
}

std::string binary_off() {
    std::string out = "COFF BINARY\n";
    const auto append = [&](std::uint32_t bits) {
        for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(bits >> shift);
    };
    const PolygonSoup s = tetrahedron();
    for (const std::uint32_t n : {4U, 4U, 6U}) append(n);
    for (const auto& p : s.V.rowwise()) {
        for (int k = 0; k < 7; ++k)
            append(std::bit_cast<std::uint32_t>(k < 3 ? static_cast<float>(p[k]) : 0.5F));
    }
    for (std::size_t i = 0; i < s.polygon_vertices.size(); ++i) {
        if (i % 3 == 0) append(3);
        append(static_cast<std::uint32_t>(s.polygon_vertices[i]));
        if (i % 3 == 2) append(0);
    }
    return out;
}

struct Sample {
    std::string name, bytes;
};

std::vector<Sample> samples() {
    const PolygonSoup blocks = joined(cube(), tetrahedron(), {0.2, 0.2, 0.2});
    return {{"cube.off", text_off(cube())},       {"binary.off", binary_off()},
            {"cube.obj", text_obj(cube())},       {"cube.ply", text_ply(cube())},
            {"big.ply", binary_big_endian_ply()}, {"little.ply", written(sphere(1), ".ply")},
            {"cube.stl", text_stl(cube())},       {"binary.stl", written(sphere(1), ".stl")},
            {"blocks.off", text_off(blocks)}};
}

/// One damage of many kinds; deterministic for a generator's state.
std::string damaged(std::string bytes, std::mt19937& random) {
    const auto below = [&](std::size_t n) {
        return static_cast<std::size_t>(random()) % std::max<std::size_t>(n, 1);
    };
    const std::size_t at = below(bytes.size());
    switch (below(9)) {
        case 0:
            return bytes.substr(0, at);
        case 1:
            for (std::size_t k = 0; k <= below(4); ++k) {
                char& c = bytes[below(bytes.size())];
                c = static_cast<char>(c ^ (1 << below(8)));
            }
            return bytes;
        case 2: {  // another number
            static const char* const kNumbers[] = {"nan",
                                                   "inf",
                                                   "-inf",
                                                   "1e300",
                                                   "1e400",
                                                   "-1",
                                                   "10000000",
                                                   "4294967296",
                                                   "0",
                                                   "-0",
                                                   "abc",
                                                   "2147483648",
                                                   "1e-400",
                                                   "3.5",
                                                   "99999999999999999999",
                                                   "-9223372036854775808",
                                                   "0x10",
                                                   "",
                                                   "1e",
                                                   "+-1",
                                                   "nan(7)"};
            std::size_t first = bytes.find_first_of("0123456789-", at);
            if (first == std::string::npos) return bytes;
            const std::size_t last = bytes.find_first_not_of("0123456789.-+e", first);
            return bytes.replace(first, (last == std::string::npos ? bytes.size() : last) - first,
                                 kNumbers[below(std::size(kNumbers))]);
        }
        case 3:  // a huge or negative binary number
            for (std::size_t k = at; k < std::min(at + 4, bytes.size()); ++k)
                bytes[k] = k % 2 == 0 ? '\xff' : '\x7f';
            return bytes;
        case 4:
            return bytes.erase(at, 1 + below(20));
        case 5:
            return bytes.insert(at, bytes.substr(below(bytes.size()), below(60)));
        case 6: {  // a line gone or doubled
            const std::size_t end = bytes.find('\n', at);
            if (end == std::string::npos) return bytes;
            const std::size_t next = std::min(bytes.find('\n', end + 1), bytes.size() - 1);
            return below(2) == 0 ? bytes.erase(end, next - end)
                                 : bytes.insert(end, bytes.substr(end, next - end));
        }
        case 7: {
            std::string noise;
            for (std::size_t k = 0; k < below(16); ++k) noise += static_cast<char>(random());
            return bytes.insert(at, noise);
        }
        default: {
            std::string crlf;
            for (const char c : bytes) crlf += c == '\n' ? "\r\n" : std::string(1, c);
            return crlf;
        }
    }
}

}  // namespace

TEST_CASE("the samples are admitted before they are damaged") {
    for (const Sample& sample : samples()) {
        if (sample.name == "blocks.off") continue;
        Outcome outcome;
        try_bytes(sample.bytes, sample.name, outcome);
        INFO(sample.name);
        CHECK(outcome.admitted == 1);
    }
}

TEST_CASE("files cut off at any byte give a result or an error") {
    Outcome outcome;
    for (const Sample& sample : samples()) {
        for (std::size_t length = 0; length < sample.bytes.size(); ++length) {
            try_bytes(sample.bytes.substr(0, length), sample.name, outcome);
        }
    }
    CHECK(outcome.read_errors > 1000);
}

TEST_CASE("thousands of damaged files give a result or an error") {
    std::mt19937 random(2004);
    Outcome outcome;
    const std::vector<Sample> originals = samples();
    for (int round = 0; round < 12000; ++round) {
        const Sample& sample = originals[random() % originals.size()];
        std::string bytes = sample.bytes;
        for (unsigned repeat = 0; repeat <= random() % 3; ++repeat) {
            if (!bytes.empty()) bytes = damaged(bytes, random);
        }
        INFO("round " << round << ", " << sample.name);
        try_bytes(bytes, sample.name, outcome);
    }
    // Each way out is well used, so none hides the others.
    CHECK(outcome.read_errors > 2000);
    CHECK(outcome.soups > 1000);
    CHECK(outcome.admitted > 500);
    CHECK(outcome.refused > 500);
}

TEST_CASE("any content under any name gives a result or an error") {
    Outcome outcome;
    for (const Sample& sample : samples()) {
        for (const char* name : {"x.off", "x.obj", "x.ply", "x.stl"}) try_bytes(sample.bytes, name, outcome);
    }
    std::mt19937 random(4);
    for (int round = 0; round < 2000; ++round) {
        std::string noise;
        for (std::size_t k = 0; k < random() % 300; ++k) noise += static_cast<char>(random());
        for (const char* name : {"x.off", "x.obj", "x.ply", "x.stl"}) try_bytes(noise, name, outcome);
    }
    CHECK(outcome.read_errors > 6000);
}

TEST_CASE("ten million vertices claimed in a hundred bytes cost nothing") {
    std::string stl(80, ' ');
    for (const char c : {'\x80', '\x96', '\x98', '\x00'}) stl += c;  // 10,000,000 triangles
    stl += std::string(50, '\0');
    const std::string counts = "10000000 20000000 0\n",
                      xyz = "property float x\nproperty float y\nproperty float z\n",
                      list = "property list uchar int vertex_indices\nend_header\n";
    const std::vector<Sample> claims = {
        {"claim.off", "OFF\n" + counts + "0 0 0\n1 0 0\n"},
        {"binary.off", "OFF BINARY\n" + std::string("\x00\x98\x96\x80\x01\x31\x2d\x00\x00\x00\x00\x00", 12)},
        {"polygon.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n10000000 0 1 2\n"},
        {"claim.ply",
         "ply\nformat ascii 1.0\nelement vertex 10000000\n" + xyz + "element face 20000000\n" + list},
        {"binary.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 10000000\n" + xyz +
                           "element face 20000000\n" + list + "0123456789"},
        {"empty.ply",
         "ply\nformat binary_little_endian 1.0\nelement vertex 10000000\nelement face 0\n" + list},
        {"claim.stl", stl},
        {"claim.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 10000000\n"}};
    for (const Sample& claim : claims) {
        INFO(claim.name);
        Outcome outcome;
        try_bytes(claim.bytes, claim.name, outcome);  // measures the memory
        CHECK(outcome.read_errors == 1);
    }
}

TEST_CASE("zero bytes, wrong beginnings and byte order marks are errors that name the file") {
    for (const char* extension : {".off", ".obj", ".ply", ".stl"}) {
        for (const std::string& bytes :
             {std::string(), std::string("\0", 1), std::string(200, '\0'), std::string("PK\x03\x04"),
              std::string("\xff\xfe"), std::string("\n\n\n")}) {
            // In any script.
            for (const char* name : {"netz", "\xe7\xbd\x91\xe6\xa0\xbc",
                                     "se\xc3\xb1"
                                     "al \xf0\x9f\x99\x82"}) {
                INFO(name << extension << ", " << bytes.size() << " bytes");
                Outcome outcome;
                try_bytes(bytes, std::string(name) + extension, outcome);
                CHECK(outcome.admitted == 0);
                CHECK(outcome.read_errors + outcome.refused >= 1);
            }
        }
    }
}
