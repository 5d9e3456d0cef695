#include "render/program/turntable_files.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "morph/mesh/errors.h"
#include "morph/mesh/write_file.h"
#include "render/figure/names.h"
#include "render/image/content_hash.h"
#include "render/program/frame_files.h"
#include "render/program/timeline_names.h"
#include "render/program/version.h"

namespace automorph::program {
namespace {

namespace fs = std::filesystem;

/// All that every frame depends on.
nlohmann::ordered_json common_inputs(const TurntableArguments& arguments,
                                     const turntable::StageOptions& stage) {
    const auto hash = [](const fs::path& mesh) { return render::content_hash(file_content(mesh)); };
    nlohmann::ordered_json json;
    json["version"] = version();
    json["mesh"] = hash(arguments.source);
    if (!arguments.target.empty()) {
        json["target"] = hash(arguments.target);
        json["alignment"] = name_of(kAlignments, arguments.morph.alignment);
        json["interpolation"] = name_of(kInterpolations, arguments.interpolation);
        json["openings"] = name_of(kOpenings, arguments.morph.openings);
        json["domain"] = name_of(kDomains, arguments.morph.domain);
        json["lift"] = arguments.morph.lift;
    }
    const turntable::TimelineOptions& timeline = arguments.timeline;
    json["frames"] = timeline.frames;
    json["start"] = timeline.start;
    json["revolutions"] = timeline.revolutions;
    json["shutter"] = timeline.shutter;
    json["turn_easing"] = name_of(kEasings, timeline.turn_easing);
    if (timeline.alpha) {
        json["alpha"] = *timeline.alpha;
    } else {
        json["loop"] = name_of(kLoops, timeline.loop);
        json["easing"] = name_of(kEasings, timeline.morph_easing);
        json["hold"] = timeline.hold;
    }
    json["up"] = {stage.up.x(), stage.up.y(), stage.up.z()};
    json["view"] = {stage.view.x(), stage.view.y(), stage.view.z()};
    json["elevation"] = stage.elevation;
    json["fov"] = stage.fov;
    json["margin"] = stage.margin;
    json["normals"] = name_of(kNormals, stage.normals);
    json["width"] = stage.width;
    json["height"] = stage.height;
    json["spp"] = stage.spp;
    json["seed"] = stage.seed;
    return json;
}

}  // namespace

TurntableTargets turntable_targets(const fs::path& out) {
    const std::string extension = out.extension().string();
    if (extension == ".png" || extension == ".exr") return {out, {}};
    if (extension == ".mp4" || extension == ".webm") {
        const std::string stem = out.stem().string();
        return {out.parent_path() / (stem + "_frames") / (stem + "_.png"), out};
    }
    throw IoError(fmt::format("{}: a turntable is written as .png, .exr, .mp4 or .webm", out.string()));
}

turntable::Sequence turntable_sequence(const TurntableArguments& arguments,
                                       const turntable::StageOptions& stage, const fs::path& pattern) {
    turntable::Sequence sequence;
    const int count = arguments.timeline.frames;
    std::tie(sequence.first, sequence.last) = turntable::frame_range(arguments.frame_range, count);
    for (int frame = 0; frame < count; ++frame) sequence.files.push_back(numbered(pattern, frame, count));
    sequence.inputs = [common = common_inputs(arguments, stage)](int frame) {
        nlohmann::ordered_json json = common;
        json["frame"] = frame;
        return json.dump();
    };
    return sequence;
}

void remove_turntable_leftovers(const turntable::Sequence& sequence, const fs::path& video) {
    std::set<std::string> names;
    for (int frame = sequence.first; frame <= sequence.last; ++frame)
        names.insert(sequence.files[static_cast<std::size_t>(frame)].filename().string());
    remove_leftovers(sequence.files.front().parent_path(),
                     [&](const std::string& name) { return names.count(name) > 0; });
    if (video.empty()) return;
    const fs::path place = behind_links(video);
    const std::string record = video.filename().string() + ".txt", log = video.stem().string() + ".log";
    remove_leftovers(place.parent_path(), [&](const std::string& name) { return name == place.filename(); });
    remove_leftovers(video.parent_path(), [&](const std::string& name) { return name == log; });
    remove_leftovers(sequence.files.front().parent_path(),
                     [&](const std::string& name) { return name == record; });
}

}  // namespace automorph::program
