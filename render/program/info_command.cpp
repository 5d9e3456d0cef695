#include <fmt/format.h>

#include <cstdio>

#include "render/program/commands.h"
#include "render/program/mesh_info.h"

namespace automorph::program {

int run(const InfoArguments& arguments, const Surroundings& surroundings) {
    std::vector<MeshInfo> meshes;
    int status = 0;
    for (const std::filesystem::path& file : arguments.meshes) {
        MeshInfo info = examine(file);
        if (!info.refusal.empty()) status = 1;
        if (arguments.json) {
            meshes.push_back(std::move(info));
        } else if (!info.readable) {
            fmt::print(stderr, "automorph: {}\n", info.refusal);
        } else if (!surroundings.quiet) {
            fmt::print("{}", info_text(info));
        }
    }
    if (arguments.json) fmt::print("{}", info_json(meshes));
    return status;
}

}  // namespace automorph::program
