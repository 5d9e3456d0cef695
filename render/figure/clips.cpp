#include "render/figure/clips.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "morph/mesh/write_file.h"
#include "render/figure/loops.h"
#include "render/figure/picture_progress.h"
#include "render/figure/row_subject.h"
#include "render/figure/stopwatch.h"
#include "render/image/data_uri.h"
#include "render/image/image_file.h"
#include "render/video/video_encoder.h"

namespace automorph {
namespace {

/// Standard error at which a pixel of a video has samples enough: noise of moving pictures is seen less.
constexpr double kVideoError = 0.03;
constexpr int kStillQuality = 85;  // of JPEG

/// Halfway back, the loop shows the same frames again.
int still_of(int index, int frames) {
    return std::min(index, frames - index);
}

Film film_of(const FigureConfig& config) {
    const VideoSize size = video_size(config);
    return {size.width, size.height, config.video.spp};
}

/// One camera for the loops of all rows.
Shooting loop_shooting(const FigureConfig& config, const FigureOptions& options, const Figure& figure) {
    ShootingPlan plan(config.picture, options, film_of(config));
    int time_steps = 1;  // the same for all
    for (const Motion& motion : figure.motions) {
        const FilmLoop loop = FilmLoop::of_row(config.video, motion);
        time_steps = loop.time_steps();
        for (int i = 0; i <= config.video.frames / 2; ++i) {
            for (const Points& V : loop.exposure(i)) plan.add(V);
        }
    }
    Shooting shooting = plan.shooting();
    shooting.time_steps = time_steps;
    shooting.adaptive_error = kVideoError;
    return shooting;
}

/// Those of `count` frames that are selected, from 0.
std::vector<int> selected_frames(const Selection& frames, int count) {
    std::vector<int> selected;
    for (int i = 0; i < count; ++i) {
        if (frames.has(static_cast<std::size_t>(i))) selected.push_back(i);
    }
    return selected;
}

constexpr const char* kTurntableName = "turntable";

/// The videos of a clip for the page, unless one is too large to go into it.
std::vector<std::string> films_of(const std::filesystem::path& folder, const std::string& name) {
    constexpr std::uintmax_t kLargest = 4u << 20;  // bytes
    std::vector<std::string> films;
    for (const std::filesystem::path& file : video_files(folder, name)) {
        if (std::filesystem::file_size(file) > kLargest) return {};
        films.push_back(render::data_uri("video/" + file.extension().string().substr(1), file_content(file)));
    }
    return films;
}

std::string row_clip_name(std::size_t number) {
    return fmt::format("row{}", number + 1);
}

void encode(const std::vector<VideoFrame>& stills, const std::vector<int>& still_of_frame, double fps,
            const std::vector<std::filesystem::path>& files) {
    VideoEncoder encoder(files, stills.front().width, stills.front().height, fps);
    for (const int still : still_of_frame) encoder.add(stills[static_cast<std::size_t>(still)]);
    encoder.finish();
}

/// By what frames of a row are coloured.
class FrameColors {
public:
    FrameColors(const FigureConfig& config, const Motion& motion) : field_(config.picture.color) {
        if (field_ != ColorField::None) source_ = {motion.morph->endpoints().a, motion.morph->triangles()};
    }

    /// Empty if by nothing.
    Eigen::VectorXd of(const FilmLoop& loop, int index) const {
        if (field_ == ColorField::None) return {};
        return color_field(field_, source_, loop.unturned(index));
    }

private:
    ColorField field_;
    Mesh source_;
};

/// Renders the stills that the selected frames need and makes the video of them.
Clip row_clip(const FigureConfig& config, const Shooting& shooting, const Figure& figure,
              const FigureRow& row, const std::filesystem::path& folder, bool encodes) {
    const int frames = config.video.frames;
    const std::string task = fmt::format("video of row {} ({})", row.number + 1, row.config.label);
    std::vector<int> stills, shown;  // numbers of stills; per frame its place among them
    for (const int i : selected_frames(shooting.options.frames, frames))
        stills.push_back(still_of(i, frames));
    shown = stills;
    std::sort(stills.begin(), stills.end());
    stills.erase(std::unique(stills.begin(), stills.end()), stills.end());
    for (int& still : shown)
        still = static_cast<int>(std::lower_bound(stills.begin(), stills.end(), still) - stills.begin());

    Clip clip;
    clip.name = row_clip_name(row.number);
    clip.width = shooting.width;
    clip.height = shooting.height;
    clip.frames = static_cast<int>(shown.size());
    RowSubject subject(shooting, row, figure.scale);
    const FilmLoop loop = FilmLoop::of_row(config.video, row.motion);
    const FrameColors colors(config, row.motion);
    PictureProgress progress(shooting.options.progress, task, "picture", stills.size());
    std::vector<VideoFrame> pictures;
    for (const int still : stills) {
        subject.correct_normals(loop.shading(still));
        const FigureCell cell = subject.shoot(loop.exposure(still), colors.of(loop, still),
                                              progress.begin(pictures.size() + 1, shooting.samples()),
                                              static_cast<std::uint32_t>(still));
        progress.end(cell.samples, cell.rays);
        clip.alphas.push_back(loop_alpha(still, frames));
        clip.stills.push_back(render::jpeg_data_uri(cell.image, kStillQuality));
        clip.seconds += cell.seconds;
        pictures.push_back(video_frame(cell.image));
    }
    if (encodes) {
        encode(pictures, shown, config.video.fps, video_files(folder, clip.name));
        clip.films = films_of(folder, clip.name);
    }
    clip.encoded = encodes;
    progress.finish();
    return clip;
}

/// Number of the row that turns.
std::size_t turning_row(const FigureConfig& config) {
    return config.video.turntable_row > 0 ? static_cast<std::size_t>(config.video.turntable_row) - 1
                                          : config.rows.size() - 1;
}

/// Frames go to ffmpeg as they are rendered.
Clip turntable_clip(const FigureConfig& config, const FigureOptions& options, const Figure& figure,
                    const FigureRow& row, const std::filesystem::path& folder) {
    const std::string task = fmt::format("turntable of row {} ({})", row.number + 1, row.config.label);
    const FilmLoop table = FilmLoop::on_turntable(config, row.motion);
    ShootingPlan plan(config.picture, options, film_of(config));
    for (int i = 0; i < config.video.turntable; ++i) {
        for (const Points& V : table.exposure(i)) plan.add(V);
    }
    Shooting shooting = plan.shooting();
    shooting.time_steps = table.time_steps();
    shooting.adaptive_error = kVideoError;

    Clip clip;
    clip.name = kTurntableName;
    clip.width = shooting.width;
    clip.height = shooting.height;
    RowSubject subject(shooting, row, figure.scale);
    const FrameColors colors(config, row.motion);
    VideoEncoder encoder(video_files(folder, clip.name), clip.width, clip.height, config.video.fps);
    const std::vector<int> indices = selected_frames(options.frames, config.video.turntable);
    PictureProgress progress(options.progress, task, "frame", indices.size());
    for (const int i : indices) {
        subject.correct_normals(table.shading(i));
        const FigureCell cell = subject.shoot(table.exposure(i), colors.of(table, i),
                                              progress.begin(static_cast<std::size_t>(i), shooting.samples()),
                                              static_cast<std::uint32_t>(i));
        progress.end(cell.samples, cell.rays);
        clip.seconds += cell.seconds;
        ++clip.frames;
        encoder.add(video_frame(cell.image));
    }
    encoder.finish();
    clip.films = films_of(folder, clip.name);
    clip.encoded = true;
    progress.finish();
    return clip;
}

}  // namespace

VideoSize video_size(const FigureConfig& config) {
    const double longer = std::max(config.picture.width, config.picture.height);
    const auto side = [&](int cell) {
        return std::max(2, 2 * static_cast<int>(std::lround(0.5 * config.video.size * cell / longer)));
    };
    return {side(config.picture.width), side(config.picture.height)};
}

bool has_row_clips(const FigureConfig& config, const FigureOptions& options) {
    return config.show == Show::Morph && !selected_frames(options.frames, config.video.frames).empty();
}

bool has_turntable(const FigureConfig& config, const FigureOptions& options) {
    return config.show == Show::Morph && options.rows.has(turning_row(config)) &&
           !selected_frames(options.frames, config.video.turntable).empty();
}

std::vector<std::string> clip_names(const FigureConfig& config, const FigureOptions& options) {
    std::vector<std::string> names;
    if (has_row_clips(config, options)) {
        for (std::size_t row = 0; row < config.rows.size(); ++row) {
            if (options.rows.has(row)) names.push_back(row_clip_name(row));
        }
    }
    if (has_turntable(config, options)) names.emplace_back(kTurntableName);
    return names;
}

std::vector<std::filesystem::path> video_files(const std::filesystem::path& folder, const std::string& name) {
    return {folder / (name + ".mp4"), folder / (name + ".webm")};
}

void make_clips(const FigureConfig& config, const FigureOptions& options, const std::filesystem::path& folder,
                Figure& figure) {
    const bool filmed = has_row_clips(config, options), turned = has_turntable(config, options);
    if (!filmed && !turned) return;
    const Stopwatch filming;
    make_folder(folder);
    const bool encodes = has_ffmpeg();
    if (!encodes) figure.no_videos = "the program ffmpeg is not installed (Debian package ffmpeg)";
    if (filmed) {
        const Shooting shooting = loop_shooting(config, options, figure);
        for (FigureRow& row : figure.rows)
            row.clip = row_clip(config, shooting, figure, row, folder, encodes);
    }
    for (const FigureRow& row : figure.rows) {
        if (encodes && turned && row.number == turning_row(config))
            figure.turntable = turntable_clip(config, options, figure, row, folder);
    }
    figure.video_seconds = filming.seconds();
}

}  // namespace automorph
