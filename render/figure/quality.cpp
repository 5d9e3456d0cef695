#include "render/figure/quality.h"

#include <algorithm>

namespace automorph {
namespace {

void draft(PictureConfig& picture, VideoConfig& video) {
    constexpr int kFewestPixels = 16, kLeastSpp = 2, kFrames = 24;
    picture.width = std::max(picture.width / 2, std::min(picture.width, kFewestPixels));
    picture.height = std::max(picture.height / 2, std::min(picture.height, kFewestPixels));
    picture.spp = std::max(picture.spp / 8, std::min(picture.spp, kLeastSpp));
    picture.denoise = true;
    video.fps *= static_cast<double>(std::min(video.frames, kFrames)) / std::max(video.frames, 1);
    video.fps = std::max(video.fps, 1.0);
    video.frames = std::min(video.frames, kFrames);
    video.size = std::max(video.size / 2, std::min(video.size, kFewestPixels));
    video.spp = std::max(video.spp / 4, std::min(video.spp, kLeastSpp));
    video.turntable = 0;
}

void print(PictureConfig& picture, VideoConfig& video) {
    picture.width *= 2;
    picture.height *= 2;
    picture.spp *= 4;
    video.size *= 2;
    video.spp *= 4;
    video.frames *= 2;
    video.fps *= 1.5;
    video.turntable *= 2;
}

}  // namespace

void apply_quality(Quality quality, FigureConfig& config) {
    if (quality == Quality::Draft) draft(config.picture, config.video);
    if (quality == Quality::Final) print(config.picture, config.video);
}

}  // namespace automorph
