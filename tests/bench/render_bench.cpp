#include "tests/bench/render_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "morph/mesh/errors.h"
#include "render/denoise/denoise.h"
#include "render/image/image_file.h"
#include "render/integrator/render.h"
#include "tests/bench/bench_scenes.h"
#include "tests/bench/child_process.h"
#include "tests/bench/cycles_job.h"
#include "tests/bench/minimal_tracer.h"
#include "tests/bench/moving_bench.h"

namespace automorph::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 320, kHeight = 240, kSpp = 64, kRepeats = 5;

BenchMeshes bench_meshes() {
    return read_bench_meshes(AUTOMORPH_DEMO_MESHES "/mannequin-devil.off");
}

MinimalScene make_minimal_scene(const BenchMeshes& meshes) {
    MinimalScene scene;
    const auto copy = [](const Mesh& from, std::vector<float>& vertices,
                         std::vector<std::uint32_t>& triangles) {
        for (Eigen::Index i = 0; i < from.V.size(); ++i)
            vertices.push_back(static_cast<float>(from.V.data()[i]));
        for (Eigen::Index i = 0; i < from.F.size(); ++i)
            triangles.push_back(static_cast<std::uint32_t>(from.F.data()[i]));
    };
    copy(meshes.mesh, scene.vertices, scene.triangles);
    copy(meshes.ground, scene.ground_vertices, scene.ground_triangles);
    return scene;
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

std::string spread(const std::vector<double>& values) {
    return fmt::format("median of {}; {:.3f} to {:.3f}", values.size(),
                       *std::min_element(values.begin(), values.end()),
                       *std::max_element(values.begin(), values.end()));
}

double cpu_seconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

render::RenderOptions bench_options() {
    render::RenderOptions options;
    options.width = kWidth;
    options.height = kHeight;
    options.spp = kSpp;
    options.max_scatter = kMaxScatter;
    options.filter = render::Filter::Box;
    options.threads = 1;
    return options;
}

/// Returns whether both show the same.
bool rays() {
    const BenchMeshes meshes = bench_meshes();
    render::Scene scene = make_scene(meshes, bench_scenes().front());
    const MinimalScene minimal = make_minimal_scene(meshes);
    render::RenderOptions options = bench_options();
    options.roulette_after = kMaxScatter;  // the same rays
    options.split = false;

    std::vector<double> ours, theirs, ratios;
    double our_mean = 0.0, their_mean = 0.0;
    for (int k = 0; k <= kRepeats; ++k) {
        const double start = cpu_seconds();
        const render::RenderResult a = render::render(scene, bench_camera(), options);
        const double seconds = cpu_seconds() - start;
        const MinimalResult b = minimal_trace(minimal, kWidth, kHeight, kSpp, kMaxScatter);
        if (k == 0) continue;  // warm up
        ours.push_back(1e-6 * static_cast<double>(a.rays) / seconds);
        theirs.push_back(1e-6 * static_cast<double>(b.rays) / b.cpu_seconds);
        ratios.push_back(ours.back() / theirs.back());
        our_mean = their_mean = 0.0;
        for (const float x : a.image.pixels) our_mean += static_cast<double>(x) / (3.0 * kWidth * kHeight);
        for (const float x : b.pixels) their_mean += static_cast<double>(x) / (1.0 * kWidth * kHeight);
    }
    fmt::print(
        "rays     {:.2f} million per CPU second, the smallest path tracer {:.2f}: ratio {:.3f} (aim 0.85; "
        "{})\n"
        "         mean radiance {:.5f} and {:.5f}\n",
        median(ours), median(theirs), median(ratios), spread(ratios), our_mean, their_mean);
    constexpr double kSame = 5e-4;  // relative; the noise of the mean is a tenth of it
    const bool same = std::abs(our_mean - their_mean) <= kSame * their_mean;
    if (!same) fmt::print("         the pictures differ\n");
    return same;
}

void threads() {
    struct Cost {
        double wall, cpu;
    };
    render::Scene scene = make_scene(bench_meshes(), bench_scenes().front());
    const auto cost = [&](int count) {
        render::RenderOptions options = bench_options();
        options.threads = count;
        const double start = cpu_seconds();
        const double wall = render::render(scene, bench_camera(), options).wall_seconds;
        return Cost{wall, cpu_seconds() - start};
    };
    cost(2);  // warm up
    std::vector<double> quicker, work, cores_one, cores_two;
    for (int k = 0; k < kRepeats; ++k) {
        const Cost one = cost(1), two = cost(2);
        quicker.push_back(one.wall / two.wall);
        work.push_back(two.cpu / one.cpu);
        cores_one.push_back(one.cpu / one.wall);
        cores_two.push_back(two.cpu / two.wall);
    }
    // Where other programs run, threads do not get cores of their own, which is no fault of theirs: the clock
    // is to be believed if one had 1 and two had nearly 2.
    fmt::print(
        "threads  two are {:.2f} times as quick as one by the clock (aim 1.85; {}) and take {:.3f} of its "
        "CPU time;\n"
        "         one had {:.2f}, two had {:.2f} of {} cores\n",
        median(quicker), spread(quicker), median(work), median(cores_one), median(cores_two),
        std::thread::hardware_concurrency());
}

void memory() {
    constexpr int kAround = 1000, kAcross = 500;
    const auto peak = [](const std::function<void()>& body) {
        const auto run = [&] {
            body();
            return std::string("done");
        };
        const ChildResult child = run_in_child(run, {});
        if (!child.failure.empty()) throw Error(child.failure);
        return child.peak_memory_mb;
    };
    const double nothing = peak([] {});
    const double all = peak([] {
        render::Scene scene;
        {
            const Mesh mesh = torus(kAround, kAcross);
            scene.add_mesh(mesh.V, mesh.F, {});
        }
        scene.lights.push_back(bench_light());
        render::RenderOptions options = bench_options();
        options.width = 640;
        options.height = 480;
        options.spp = 1;
        options.threads = 0;
        render::render(scene, bench_camera(), options);
    });
    fmt::print(
        "memory   {:.0f} MB at most for {} triangles, smooth, at 640 x 480 (aim 400); {:.0f} MB of it "
        "without\n",
        all, 2 * kAround * kAcross, nothing);
}

void start() {
    constexpr int kStarts = 9;
    for (const std::string& arguments :
         {std::string("--version"), std::string("info '" AUTOMORPH_DEMO_MESHES "/cow.off'")}) {
        std::vector<double> seconds, wall;
        const std::string command = fmt::format("'{}' {} >/dev/null 2>&1", AUTOMORPH_PROGRAM, arguments);
        for (int k = 0; k < kStarts; ++k) {
            const ChildResult child = run_in_child(
                [&] { return std::system(command.c_str()) == 0 ? std::string("good") : std::string("bad"); },
                {});
            if (child.output != "good") throw Error(fmt::format("failed: {}", command));
            seconds.push_back(child.cpu_seconds);
            wall.push_back(child.seconds);
        }
        fmt::print("start    automorph {}: {:.3f} CPU s, {:.3f} s by the clock (aim 0.3; {})\n",
                   arguments.substr(0, arguments.find(" '")), median(seconds), median(wall), spread(wall));
    }
}

/// The mean of pictures, value by value.
std::vector<double> mean_of(const std::vector<render::Image>& pictures) {
    std::vector<double> mean(pictures.front().pixels.size(), 0.0);
    for (const render::Image& picture : pictures) {
        for (std::size_t i = 0; i < mean.size(); ++i)
            mean[i] += static_cast<double>(picture.pixels[i]) / static_cast<double>(pictures.size());
    }
    return mean;
}

/// relMSE of one picture, from several of independent noise: their variance, relative to the squared
/// radiance.
double relative_error(const std::vector<render::Image>& pictures, const std::vector<double>& radiance) {
    constexpr double kDark = 0.01;  // squared radiance below which errors count absolutely
    const std::vector<double> mean = mean_of(pictures);
    double sum = 0.0;
    for (const render::Image& picture : pictures) {
        for (std::size_t i = 0; i < mean.size(); ++i) {
            const double difference = static_cast<double>(picture.pixels[i]) - mean[i];
            sum += difference * difference / (radiance[i] * radiance[i] + kDark);
        }
    }
    return sum / static_cast<double>(mean.size() * (pictures.size() - 1));
}

void noise() {
    if (!cycles_is_installed()) {
        fmt::print(
            "noise    not measured: it is compared with Cycles, and Blender is not installed (Debian package "
            "blender)\n");
        return;
    }
    constexpr int kPictures = 4;
    const BenchMeshes meshes = bench_meshes();
    const fs::path folder = fs::temp_directory_path() / fmt::format("automorph_bench_{}", std::clock());
    fs::create_directories(folder);
    for (const BenchScene& what : bench_scenes()) {
        if (what.smooth) continue;
        std::vector<CyclesJob> jobs;
        for (int seed = 0; seed < kPictures; ++seed)
            jobs.push_back(
                {what, kWidth, kHeight, kSpp, seed, 1, fs::absolute(folder / fmt::format("{}.exr", seed))});
        std::vector<render::Image> ours, theirs, all;
        double our_seconds = 0.0, their_seconds = 0.0;
        for (const double seconds : run_cycles(meshes, jobs, folder)) their_seconds += seconds / kPictures;
        for (const CyclesJob& job : jobs) {
            theirs.push_back(render::read_image(job.output).image);
            const double before = cpu_seconds();
            render::Scene scene = make_scene(meshes, what);
            render::RenderOptions options = bench_options();
            options.seed = static_cast<std::uint64_t>(job.seed);
            ours.push_back(render::render(scene, bench_camera(), options).image);
            our_seconds += (cpu_seconds() - before) / kPictures;
        }
        all = ours;
        all.insert(all.end(), theirs.begin(), theirs.end());
        const std::vector<double> radiance = mean_of(all);
        const double our_error = relative_error(ours, radiance),
                     their_error = relative_error(theirs, radiance);
        fmt::print(
            "noise    {}: relMSE x CPU s = {:.2e} x {:.2f} = {:.2e}, Cycles {:.2e} x {:.2f} = {:.2e}: ratio "
            "{:.3f} (aim 0.333)\n",
            what.name, our_error, our_seconds, our_error * our_seconds, their_error, their_seconds,
            their_error * their_seconds, our_error * our_seconds / (their_error * their_seconds));
        std::fflush(stdout);
    }
    fs::remove_all(folder);
}

/// relMSE against a picture of much less noise.
double error_against(const render::Image& picture, const render::Image& reference) {
    constexpr double kDark = 0.01;
    double sum = 0.0;
    for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
        const auto truth = static_cast<double>(reference.pixels[i]);
        const double difference = static_cast<double>(picture.pixels[i]) - truth;
        sum += difference * difference / (truth * truth + kDark);
    }
    return sum / static_cast<double>(reference.pixels.size());
}

void denoising() {
    constexpr int kFew = 16, kMany = 1024;
    const BenchMeshes meshes = bench_meshes();
    for (const BenchScene& what : bench_scenes()) {
        render::Scene scene = make_scene(meshes, what);
        render::RenderOptions options = bench_options();
        options.spp = kFew;
        options.layers = true;
        double start_seconds = cpu_seconds();
        const render::RenderResult noisy = render::render(scene, bench_camera(), options);
        const double rendering = cpu_seconds() - start_seconds;
        start_seconds = cpu_seconds();
        const render::Image smooth = render::denoise(noisy.image, *noisy.layers);
        const double seconds = cpu_seconds() - start_seconds;
        options.spp = kMany;
        options.seed = 1;
        options.layers = false;
        const render::Image truth = render::render(scene, bench_camera(), options).image;
        const double before = error_against(noisy.image, truth), after = error_against(smooth, truth);
        fmt::print(
            "denoise  {:3}: relMSE at {} samples {:.2e}, denoised {:.2e}: {:.1f} times less, for {:.2f} CPU "
            "s beside {:.2f}\n",
            what.name, kFew, before, after, before / after, seconds, rendering);
        std::fflush(stdout);
    }
}

}  // namespace

int render_bench(const std::vector<std::string>& arguments) {
    bool same = true;
    // Those first that start processes: a process with threads must not be copied.
    const std::vector<std::pair<std::string, std::function<void()>>> parts{
        {"memory", memory},    {"start", start},         {"rays", [&] { same = rays(); }},
        {"threads", threads},  {"moving", moving_bench}, {"noise", noise},
        {"denoise", denoising}};
    for (const std::string& argument : arguments) {
        if (std::none_of(parts.begin(), parts.end(),
                         [&](const auto& part) { return part.first == argument; })) {
            fmt::print(stderr,
                       "automorph_bench render: there is no part {}; there are rays, threads, memory, "
                       "moving, start, noise, denoise\n",
                       argument);
            return 2;
        }
    }
    fmt::print("{} x {} pixels, {} samples, one thread where nothing else is said\n", kWidth, kHeight, kSpp);
    for (const auto& [name, part] : parts) {
        if (arguments.empty() || std::find(arguments.begin(), arguments.end(), name) != arguments.end())
            part();
        std::fflush(stdout);
    }
    return same ? 0 : 1;
}

}  // namespace automorph::bench
