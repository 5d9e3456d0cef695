#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "overlay_bench.h"
#include "tests/bench/accuracy_bench.h"
#include "tests/bench/cycles_bench.h"
#include "tests/bench/limbs_bench.h"
#include "tests/bench/pairs_bench.h"
#include "tests/bench/power_bench.h"
#include "tests/bench/registration_bench.h"
#include "tests/bench/render_bench.h"

namespace {

constexpr const char* kHelp =
    "automorph_bench overlay [A.off B.off]...   the overlay of disk maps beside CGAL's Arrangement_2;\n"
    "                                           without files: pairs of the example meshes in build/meshes\n"
    "automorph_bench accuracy [--ablation] [--only VARIANT]... [DIR]\n"
    "                                           the correspondence of whole morphs against ground truth "
    "in\n"
    "                                           DIR (default ../shared/meshes), and what each part gives\n"
    "automorph_bench pairs [--all | --sample N] [--seed N] [--only TEXT] [--shard I/N] [--log FILE] [--flat] "
    "[DIR]...\n"
    "                                           pairs of the meshes in build/meshes and DIR, each in a "
    "process "
    "of its own;\n"
    "                                           with FILE a run that was stopped goes on, and processes "
    "share "
    "the work\n"
    "automorph_bench registration [--poses N] [--seed N] [--only TEXT] [--open3d]\n"
    "                                           shapes found again from any pose, with noise, with parts "
    "missing;\n"
    "                                           --open3d: beside FPFH + RANSAC + ICP of Open3D\n"
    "automorph_bench limbs [A B]...             what laying arms, legs, horns on one another gives on these "
    "pairs\n"
    "                                           of build/meshes\n"
    "automorph_bench render [PART]...           what the path tracer costs, beside the smallest path tracer "
    "and Cycles;\n"
    "                                           parts: rays, threads, memory, moving, start, noise, denoise\n"
    "automorph_bench cycles DIR [--spp N] [--size WxH] [S1|S1s|S2|S3]...\n"
    "                                           our pictures against those of Cycles, which are kept in "
    "DIR\n"
    "automorph_bench power [--pairs N] [--limit SPP] [FIGURE]...\n"
    "                                           what the statistical comparison sees in the goldens of these "
    "figures:\n"
    "                                           deliberate changes, and N pairs of seeds (default 100)\n";

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    try {
        if (!arguments.empty() && arguments[0] == "overlay")
            return automorph::bench::overlay_bench({arguments.begin() + 1, arguments.end()});
        if (!arguments.empty() && arguments[0] == "accuracy")
            return automorph::bench::accuracy_bench({arguments.begin() + 1, arguments.end()});
        if (!arguments.empty() && arguments[0] == "pairs")
            return automorph::bench::pairs_bench({arguments.begin() + 1, arguments.end()});
        if (!arguments.empty() && arguments[0] == "registration")
            return automorph::bench::registration_bench({arguments.begin() + 1, arguments.end()});
        if (!arguments.empty() && arguments[0] == "limbs")
            return automorph::bench::limbs_bench({arguments.begin() + 1, arguments.end()});
        if (!arguments.empty() && arguments[0] == "render")
            return automorph::bench::render_bench({arguments.begin() + 1, arguments.end()});
        if (!arguments.empty() && arguments[0] == "cycles")
            return automorph::bench::cycles_bench({arguments.begin() + 1, arguments.end()});
        if (!arguments.empty() && arguments[0] == "power")
            return automorph::bench::power_bench({arguments.begin() + 1, arguments.end()});
        std::fputs(kHelp, arguments.empty() || arguments[0] == "help" ? stdout : stderr);
        return arguments.empty() || arguments[0] == "help" ? 0 : 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "automorph_bench: %s\n", error.what());
        return 1;
    }
}
