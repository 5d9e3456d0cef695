#include "tests/bench/open3d.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "morph/mesh/io.h"

namespace automorph::bench {

namespace {

namespace fs = std::filesystem;

constexpr const char* kPython = "/usr/bin/python3";  // Debian's, for which its packages are

/// A folder of its own that goes when it is left.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string name = (fs::temp_directory_path() / "automorph-open3d-XXXXXX").string();
        if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder can be made");
        path = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    fs::path path;
};

bool runs(const std::string& command) {
    return std::system(command.c_str()) == 0;
}

}  // namespace

bool has_open3d() {
    return runs(fmt::format("{} -c 'import open3d' >/dev/null 2>&1", kPython));
}

std::vector<Open3dPose> open3d_rotations(const std::vector<std::pair<Mesh, Mesh>>& pairs) {
    const TemporaryFolder folder;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        write_mesh((folder.path / fmt::format("{}_a.ply", k)).string(), pairs[k].first);
        write_mesh((folder.path / fmt::format("{}_b.ply", k)).string(), pairs[k].second);
    }
    if (!runs(fmt::format("{} '{}' '{}' >/dev/null", kPython,
                          AUTOMORPH_BENCH_FOLDER "/open3d_registration.py", folder.path.string())))
        throw std::runtime_error("Open3D's registration failed");
    std::ifstream file(folder.path / "rotations.txt");
    std::vector<Open3dPose> poses(pairs.size());
    for (Open3dPose& pose : poses) {
        for (int k = 0; k < 9; ++k) file >> pose.R(k / 3, k % 3);
        file >> pose.cpu_seconds;
    }
    if (!file) throw std::runtime_error("Open3D's rotations.txt is too short");
    return poses;
}

}  // namespace automorph::bench
