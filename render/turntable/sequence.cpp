#include "render/turntable/sequence.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "morph/mesh/errors.h"
#include "render/figure/picture_progress.h"

namespace automorph::turntable {
namespace {

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

std::vector<MadeFrame> make_frames(Stage& stage, const std::vector<Exposure>& exposures,
                                   const Sequence& sequence, const std::vector<OpenFrame>& frames,
                                   const Progress& progress,
                                   const std::function<void(const MadeFrame&)>& told) {
    std::vector<MadeFrame> made;
    PictureProgress telling(progress, "turntable", "frame", frames.size());
    for (const OpenFrame& open : frames) {
        const int frame = open.frame;
        const render::RenderResult result =
            stage.picture(exposures[static_cast<std::size_t>(frame)], frame,
                          telling.begin(static_cast<std::size_t>(frame), stage.samples()));
        write_frame(sequence.files[static_cast<std::size_t>(frame)], result.image, sequence.inputs(frame));
        telling.end(result.samples, result.rays);
        made.push_back({frame, result.wall_seconds, result.rays, result.bad_samples});
        if (told) told(made.back());
    }
    if (!frames.empty()) telling.finish();
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
