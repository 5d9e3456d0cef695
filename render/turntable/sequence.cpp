#include "render/turntable/sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "morph/mesh/errors.h"
#include "render/figure/stopwatch.h"

namespace automorph::turntable {
namespace {

/// "3.4 M".
std::string rate_text(double per_second) {
    return per_second >= 1e5 ? fmt::format("{:.1f} M", 1e-6 * per_second)
                             : fmt::format("{:.1f} k", 1e-3 * per_second);
}

std::optional<int> number(const std::string& text) {
    int value = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (read.ec != std::errc() || read.ptr != text.data() + text.size() || value < 0) return std::nullopt;
    return value;
}

}  // namespace

std::vector<OpenFrame> open_frames(const Sequence& sequence) {
    std::vector<OpenFrame> frames;
    for (int frame = sequence.first; frame <= sequence.last; ++frame) {
        const FrameState state =
            frame_state(sequence.files[static_cast<std::size_t>(frame)], sequence.inputs(frame));
        if (state != FrameState::Finished) frames.push_back({frame, state});
    }
    return frames;
}

std::vector<MadeFrame> make_frames(Stage& stage, const std::vector<Moment>& moments, const Sequence& sequence,
                                   const std::vector<OpenFrame>& frames, const Progress& progress,
                                   const std::function<void(const MadeFrame&)>& told) {
    const Stopwatch watch;
    std::vector<MadeFrame> made;
    double samples = 0, rays = 0;  // of the frames before
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const int frame = frames[i].frame;
        const std::string place = fmt::format("frame {} ({} of {})", frame, i + 1, frames.size());
        const double per_frame = stage.samples();
        const auto tell = [&](double fraction) {
            if (!progress) return;
            // The sequence is done when its last file is written, not before.
            const double done =
                (static_cast<double>(i) + std::min(fraction, 0.999)) / static_cast<double>(frames.size());
            std::string detail = place;
            const double seconds = watch.seconds(), taken = samples + fraction * per_frame;
            if (seconds > 0.5) {
                detail += fmt::format(", {} samples/s", rate_text(taken / seconds));
                // Rays are counted when a frame is done.
                if (samples > 0)
                    detail += fmt::format(", {} rays/s", rate_text(rays / samples * taken / seconds));
            }
            progress("turntable", done, detail);
        };
        tell(0);
        const render::RenderResult result =
            stage.picture(moments[static_cast<std::size_t>(frame)], frame, tell);
        write_frame(sequence.files[static_cast<std::size_t>(frame)], result.image, sequence.inputs(frame));
        samples += static_cast<double>(result.samples);
        rays += static_cast<double>(result.rays);
        made.push_back({frame, result.wall_seconds, result.rays, result.bad_samples});
        if (told) told(made.back());
    }
    if (!frames.empty()) progress("turntable", 1);
    return made;
}

std::pair<int, int> frame_range(const std::string& text, int count) {
    if (text.empty()) return {0, count - 1};
    const std::size_t dash = text.find('-');
    const std::optional<int> first = number(text.substr(0, dash));
    std::optional<int> last = first;
    if (dash != std::string::npos) last = dash + 1 == text.size() ? count - 1 : number(text.substr(dash + 1));
    if (!first || !last || *first > *last || *last >= count) {
        throw ConfigError(fmt::format(
            "--frame-range {}: expected first-last, first- or one number, within 0-{}", text, count - 1));
    }
    return {*first, *last};
}

}  // namespace automorph::turntable
