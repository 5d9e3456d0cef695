#include "render/program/picture_diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "morph/mesh/errors.h"
#include "morph/mesh/write_file.h"
#include "render/compare/exact.h"
#include "render/compare/pictures.h"
#include "render/image/image_file.h"

namespace automorph::program {
namespace {

namespace fs = std::filesystem;
using render::Image;
using render::NoisyImage;

const std::vector<std::string> kVariance{"variance.R", "variance.G", "variance.B"};
const std::vector<std::string> kSamples{"samples.count"};
const std::vector<std::vector<std::string>> kSurfaces{
    {"albedo.R", "albedo.G", "albedo.B"},
    {"shading_normal.X", "shading_normal.Y", "shading_normal.Z"},
    {"depth.Z"}};

bool has_noise_layers(const fs::path& file) {
    const std::vector<std::string> names = render::channel_names(file);
    const auto holds = [&](const std::string& name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    return std::all_of(kVariance.begin(), kVariance.end(), holds) && holds(kSamples.front());
}

NoisyImage read_noisy(const fs::path& file) {
    std::optional<std::vector<Image>> layers =
        render::read_layers(file, {{"R", "G", "B"}, kVariance, kSamples}, kSurfaces);
    if (!layers) {
        throw IoError(
            fmt::format("{}: there are no layers 'variance' and 'samples', without which noise cannot be "
                        "told from change; render it with --layers, or take --mode same-seed",
                        file.string()));
    }
    NoisyImage picture{std::move((*layers)[0]), std::move((*layers)[1]), std::move((*layers)[2])};
    if (layers->size() > 3) {
        picture.surfaces =
            render::Surfaces{std::move((*layers)[3]), std::move((*layers)[4]), std::move((*layers)[5])};
    }
    return picture;
}

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : " ") + name;
    return text;
}

void diff_exact(const fs::path& golden, const fs::path& found, PictureDiff& diff) {
    diff.channels = render::channel_names(golden);
    const std::vector<std::string> others = render::channel_names(found);
    if (diff.channels != others) {
        throw Error(fmt::format("channels differ: {} against {}", joined(diff.channels), joined(others)));
    }
    diff.comparison = render::compare_exact(render::read_channels(golden, diff.channels),
                                            render::read_channels(found, diff.channels));
}

void diff_same_seed(const fs::path& golden, const fs::path& found, const render::SameSeedLimits& limits,
                    PictureDiff& diff) {
    const Image a = render::read_image(golden).image, b = render::read_image(found).image;
    diff.channels =
        a.channels == 1 ? std::vector<std::string>{"grey"} : std::vector<std::string>{"red", "green", "blue"};
    diff.comparison = render::compare_same_seed(a, b, limits);
}

void diff_statistical(const fs::path& golden, const fs::path& found, double false_alarm_rate,
                      PictureDiff& diff) {
    const render::StatisticalComparison comparison =
        render::compare_statistical(read_noisy(golden), read_noisy(found), {false_alarm_rate});
    diff.channels = {"red", "green", "blue"};
    diff.comparison = comparison;
    diff.sensitivity = comparison.sensitivity;
}

DiffMode mode_for(const fs::path& golden, const fs::path& found, DiffMode asked) {
    if (asked != DiffMode::Auto) return asked;
    return has_noise_layers(golden) && has_noise_layers(found) ? DiffMode::Statistical : DiffMode::SameSeed;
}

}  // namespace

PictureDiff diff_pictures(const fs::path& golden, const fs::path& found, const DiffArguments& arguments,
                          double false_alarm_rate) {
    PictureDiff diff;
    try {
        const DiffMode mode = mode_for(golden, found, arguments.mode);
        if (mode == DiffMode::Exact) diff_exact(golden, found, diff);
        if (mode == DiffMode::SameSeed) diff_same_seed(golden, found, arguments.same_seed, diff);
        if (mode == DiffMode::Statistical) diff_statistical(golden, found, false_alarm_rate, diff);
        diff.mode = mode;
        diff.status = diff.comparison.same() ? DiffStatus::Same : DiffStatus::Different;
    } catch (const IoError& error) {  // names the file
        diff.reason = error.what();
    } catch (const Error& error) {
        diff.reason = fmt::format("{} against {}: {}", found.string(), golden.string(), error.what());
    }
    return diff;
}

void check_new_golden(const fs::path& file, DiffMode mode) {
    if (mode == DiffMode::Statistical) {
        read_noisy(file);
    } else {
        render::read_image(file);
    }
}

void write_diff_pictures(const PictureDiff& diff, const fs::path& golden, const fs::path& found,
                         const fs::path& heatmap, const fs::path& side_by_side) {
    for (const fs::path& file : {heatmap, side_by_side}) make_folder(file.parent_path());
    if (!heatmap.empty()) render::write_png(heatmap, render::heat_map(diff.comparison));
    if (side_by_side.empty()) return;
    render::write_png(side_by_side, render::side_by_side(render::read_image(golden).image,
                                                         render::read_image(found).image, diff.comparison));
}

}  // namespace automorph::program
