#include "tests/bench/cycles_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>

#include "render/image/image_file.h"
#include "render/integrator/render.h"
#include "tests/bench/bench_scenes.h"
#include "tests/bench/cycles_job.h"
#include "tests/bench/number.h"

namespace automorph::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kBlock = 16;            // pixels
constexpr double kMeanLimit = 0.003;  // of the whole picture
constexpr double kBlockLimit = 0.02;  // of a block

struct Choice {
    fs::path folder;
    int width = 320, height = 240, spp = 4096;
    std::vector<BenchScene> scenes;
};

std::optional<Choice> parse(const std::vector<std::string>& arguments) {
    Choice choice;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const auto& scenes = bench_scenes();
        const auto scene = std::find_if(scenes.begin(), scenes.end(),
                                        [&](const BenchScene& s) { return s.name == arguments[i]; });
        if (arguments[i] == "--spp" && i + 1 < arguments.size()) {
            choice.spp = number_of("--spp", arguments[++i], 1);
        } else if (arguments[i] == "--size" && i + 1 < arguments.size()) {
            const std::string& size = arguments[++i];
            const std::size_t middle = std::min(size.find('x'), size.size());
            choice.width = number_of("--size", size.substr(0, middle), kBlock);
            choice.height = number_of("--size", size.substr(std::min(middle + 1, size.size())), kBlock);
        } else if (scene != scenes.end()) {
            choice.scenes.push_back(*scene);
        } else if (choice.folder.empty() && !arguments[i].empty() && arguments[i][0] != '-') {
            choice.folder = arguments[i];
        } else {
            return {};
        }
    }
    if (choice.folder.empty()) return {};
    if (choice.scenes.empty()) choice.scenes = bench_scenes();
    return choice;
}

struct Sum {
    double ours = 0.0, theirs = 0.0;
    double difference() const { return ours / theirs - 1.0; }
};

Sum sum_over(const render::Image& ours, const render::Image& theirs, int x0, int y0, int width, int height) {
    Sum sum;
    for (int y = y0; y < y0 + height; ++y) {
        for (int i = 0; i < 3 * width; ++i) {
            sum.ours += static_cast<double>(ours.at(x0, y)[i]);
            sum.theirs += static_cast<double>(theirs.at(x0, y)[i]);
        }
    }
    return sum;
}

/// Prints the line of a scene; returns whether it is within the limits.
bool compare(const std::string& name, const render::Image& ours, const render::Image& theirs) {
    struct Block {
        int x, y;
        double difference;
    };
    std::vector<Block> blocks;
    double squares = 0.0;
    for (int y = 0; y + kBlock <= ours.height; y += kBlock) {
        for (int x = 0; x + kBlock <= ours.width; x += kBlock) {
            blocks.push_back({x, y, sum_over(ours, theirs, x, y, kBlock, kBlock).difference()});
            squares += blocks.back().difference * blocks.back().difference;
        }
    }
    std::sort(blocks.begin(), blocks.end(),
              [](const Block& a, const Block& b) { return std::abs(a.difference) > std::abs(b.difference); });
    const double mean = sum_over(ours, theirs, 0, 0, ours.width, ours.height).difference();
    const auto over = std::count_if(blocks.begin(), blocks.end(),
                                    [](const Block& b) { return std::abs(b.difference) > kBlockLimit; });
    fmt::print("{:4}  mean {:+.4f} %   blocks of {} x {}: {:.3f} % rms, {} of {} above {:.0f} %; worst", name,
               100 * mean, kBlock, kBlock, 100 * std::sqrt(squares / static_cast<double>(blocks.size())),
               over, blocks.size(), 100 * kBlockLimit);
    for (std::size_t i = 0; i < 3 && i < blocks.size(); ++i)
        fmt::print("{} {:+.2f} % at ({}, {})", i == 0 ? "" : ",", 100 * blocks[i].difference, blocks[i].x,
                   blocks[i].y);
    fmt::print("\n");
    std::fflush(stdout);
    return over == 0 && std::abs(mean) < kMeanLimit;
}

render::Image ours_of(const BenchMeshes& meshes, const BenchScene& what, const Choice& choice) {
    render::Scene scene = make_scene(meshes, what);
    render::RenderOptions options;
    options.width = choice.width;
    options.height = choice.height;
    options.spp = choice.spp;
    options.max_scatter = kMaxScatter;
    options.filter = render::Filter::Box;
    return render::render(scene, bench_camera(), options).image;
}

}  // namespace

int cycles_bench(const std::vector<std::string>& arguments) {
    const std::optional<Choice> choice = parse(arguments);
    if (!choice) {
        fmt::print(stderr, "automorph_bench cycles DIR [--spp N] [--size WxH] [S1|S1s|S2|S3]...\n");
        return 2;
    }
    const BenchMeshes meshes = read_bench_meshes(AUTOMORPH_DEMO_MESHES "/mannequin-devil.off");
    fs::create_directories(choice->folder);
    fmt::print(
        "ours against Cycles, {} x {} pixels, {} samples each; allowed are {:.1f} % of the mean, {:.0f} % of "
        "a block\n",
        choice->width, choice->height, choice->spp, 100 * kMeanLimit, 100 * kBlockLimit);
    bool good = true;
    for (const BenchScene& scene : choice->scenes) {
        const std::string stem =
            fmt::format("{}_{}x{}_{}", scene.name, choice->width, choice->height, choice->spp);
        const fs::path theirs = fs::absolute(choice->folder / (stem + "_cycles.exr"));
        if (!fs::exists(theirs)) {
            if (!cycles_is_installed()) {
                fmt::print("{:4}  no {}, and Blender is not installed (Debian package blender)\n", scene.name,
                           theirs.string());
                continue;
            }
            run_cycles(meshes, {{scene, choice->width, choice->height, choice->spp, 1, 2, theirs}},
                       choice->folder);
        }
        const render::Image ours = ours_of(meshes, scene, *choice);
        render::write_exr(choice->folder / (stem + "_ours.exr"), ours);
        good = compare(scene.name, ours, render::read_image(theirs).image) && good;
    }
    return good ? 0 : 1;
}

}  // namespace automorph::bench
