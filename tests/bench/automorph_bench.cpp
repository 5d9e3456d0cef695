#include <algorithm>
#include <cstdio>
#include <exception>
#include <iterator>
#include <string>
#include <vector>

#include "tests/bench/accuracy_bench.h"
#include "tests/bench/cycles_bench.h"
#include "tests/bench/limbs_bench.h"
#include "tests/bench/overlay_bench.h"
#include "tests/bench/pairs_bench.h"
#include "tests/bench/power_bench.h"
#include "tests/bench/registration_bench.h"
#include "tests/bench/render_bench.h"

namespace {

constexpr const char* kHelp = R"(usage: ./run bench NAME [OPTIONS]

overlay [A.off B.off]...   the overlay of disk maps beside CGAL's Arrangement_2;
                           without files: pairs of the example meshes in build/meshes
accuracy [--ablation] [--only VARIANT]... [DIR]
                           the correspondence of whole morphs against ground truth in
                           DIR (default ../shared/meshes), and what each part gives
pairs [--all | --sample N] [--seed N] [--only TEXT] [--shard I/N] [--log FILE] [--flat] [DIR]...
                           pairs of the meshes in build/meshes and DIR, each in a process of its own;
                           with FILE a run that was stopped goes on, and processes share the work
registration [--poses N] [--seed N] [--only TEXT] [--open3d]
                           shapes found again from any pose, with noise, with parts missing;
                           --open3d: beside FPFH + RANSAC + ICP of Open3D
limbs [A B]...             what laying arms, legs, horns on one another gives on these pairs of build/meshes
render [PART]...           what the path tracer costs, beside the smallest path tracer and Cycles;
                           parts: rays, threads, memory, moving, start, noise, denoise
cycles DIR [--spp N] [--size WxH] [S1|S1s|S2|S3]...
                           our pictures against those of Cycles, which are kept in DIR
power [--pairs N] [--limit SPP] [FIGURE]...
                           what the statistical comparison sees in the goldens of these figures:
                           deliberate changes, and N pairs of seeds (default 100)
)";

struct Bench {
    const char* name;
    int (*run)(const std::vector<std::string>& arguments);  ///< its exit status
};

constexpr Bench kBenches[] = {
    {"overlay", automorph::bench::overlay_bench}, {"accuracy", automorph::bench::accuracy_bench},
    {"pairs", automorph::bench::pairs_bench},     {"registration", automorph::bench::registration_bench},
    {"limbs", automorph::bench::limbs_bench},     {"render", automorph::bench::render_bench},
    {"cycles", automorph::bench::cycles_bench},   {"power", automorph::bench::power_bench},
};

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    const auto is_help = [](const std::string& a) { return a == "help" || a == "--help" || a == "-h"; };
    if (arguments.empty() || std::any_of(arguments.begin(), arguments.end(), is_help)) {
        std::fputs(kHelp, stdout);
        return 0;
    }
    const Bench* bench = std::find_if(std::begin(kBenches), std::end(kBenches),
                                      [&](const Bench& b) { return arguments[0] == b.name; });
    if (bench == std::end(kBenches)) {
        std::fprintf(stderr, "automorph_bench: there is no benchmark '%s'\n\n%s", arguments[0].c_str(),
                     kHelp);
        return 2;
    }
    try {
        return bench->run({arguments.begin() + 1, arguments.end()});
    } catch (const std::exception& error) {
        std::fprintf(stderr, "automorph_bench: %s\n", error.what());
        return 1;
    }
}
