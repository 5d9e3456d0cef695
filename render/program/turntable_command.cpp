#include <fmt/format.h>

#include <memory>
#include <optional>
#include <utility>

#include "morph/mesh/admit.h"
#include "morph/mesh/errors.h"
#include "morph/mesh/mend.h"
#include "morph/mesh/triangulate.h"
#include "morph/mesh/write_file.h"
#include "render/figure/mesh_source.h"
#include "render/figure/names.h"
#include "render/figure/stopwatch.h"
#include "render/image/content_hash.h"
#include "render/image/image_file.h"
#include "render/program/axis.h"
#include "render/program/commands.h"
#include "render/program/frame_files.h"
#include "render/program/interrupt.h"
#include "render/program/summary.h"
#include "render/program/turntable_files.h"
#include "render/turntable/sequence.h"
#include "render/video/video_encoder.h"

namespace automorph::program {
namespace {

namespace fs = std::filesystem;

turntable::StageOptions stage_options(const TurntableArguments& arguments, int threads) {
    turntable::StageOptions options;
    options.up = parse_axis(arguments.up);
    options.view = arguments.view.empty() ? usual_view(options.up) : parse_axis(arguments.view);
    options.elevation = arguments.elevation;
    options.fov = arguments.fov;
    options.margin = arguments.margin;
    options.normals = arguments.flat ? render::Normals::Flat : render::Normals::Smooth;
    options.width = arguments.width;
    options.height = arguments.height;
    options.spp = arguments.spp;
    options.seed = arguments.seed;
    options.threads = threads;
    return options;
}

/// A mesh alone need not be fit for morphing to be turned: handles, several parts and so on are welcome.
turntable::Shape rigid_shape(const fs::path& file, const Surroundings& surroundings) {
    Mesh mesh;
    const PolygonSoup soup = read_mesh(file);
    try {
        mesh = admit(soup, file.string()).mesh;
    } catch (const InvalidMesh& error) {
        surroundings.debug(fmt::format("shown as it is: {}", error.what()));
        TriangulatedSoup triangles = triangulate(soup);
        Draft draft;
        draft.V = soup.V;
        draft.F = std::move(triangles.F);
        draft.polygon = std::move(triangles.polygon);
        for (int v = 0; v < soup.V.rows(); ++v) draft.file_vertex.push_back(v);
        draft.vertex_of_file = draft.file_vertex;
        merge_coincident_vertices(draft);
        drop_unused_vertices(draft);
        if (draft.F.rows() == 0)
            throw InvalidMesh(fmt::format("{}: there are no triangles to show", file.string()));
        mesh = {std::move(draft.V), std::move(draft.F)};
    }
    if (!surroundings.quiet) {
        fmt::print("mesh          {}: {} vertices, {} triangles\n", file.string(), mesh.vertex_count(),
                   mesh.triangle_count());
    }
    return {std::move(mesh.F), [V = std::move(mesh.V)](double) { return V; }};
}

turntable::Shape morphing_shape(const TurntableArguments& arguments, const Surroundings& surroundings) {
    surroundings.progress("morph", 0);
    // Both at one size and one place, as in figures.
    MeshConfig source, target;
    source.file = arguments.source;
    target.file = arguments.target;
    MorphOptions options = arguments.morph;
    options.seed = arguments.seed;
    const auto result = std::make_shared<const Morph>(
        morph(make_mesh(source, "source"), make_mesh(target, "target"), options));
    surroundings.progress("morph", 1);
    print_morph(result->report(), surroundings);
    const Interpolation scheme = arguments.interpolation;
    return {result->triangles(), [result, scheme](double alpha) { return result->frame(alpha, scheme); },
            [result, scheme](double alpha) { return result->shading(alpha, scheme); }};
}

void make_missing(const TurntableArguments& arguments, const turntable::StageOptions& options,
                  const turntable::Sequence& sequence, const std::vector<turntable::OpenFrame>& open,
                  const Surroundings& surroundings) {
    const std::vector<turntable::Exposure> exposures = turntable::exposures(arguments.timeline);
    turntable::Shape shape = arguments.target.empty() ? rigid_shape(arguments.source, surroundings)
                                                      : morphing_shape(arguments, surroundings);
    const Stopwatch staging;
    turntable::Stage stage(std::move(shape), exposures, options);
    const render::Camera camera = stage.camera(0);
    surroundings.debug(fmt::format("stage set in {:.2f} s; the camera is at ({:.4g} {:.4g} {:.4g})",
                                   staging.seconds(), camera.position.x(), camera.position.y(),
                                   camera.position.z()));
    std::uint64_t bad = 0;
    const Stopwatch watch;
    turntable::make_frames(
        stage, exposures, sequence, open, surroundings.progress, [&](const turntable::MadeFrame& made) {
            const turntable::Moment& moment = exposures[static_cast<std::size_t>(made.frame)].middle();
            bad += made.bad_samples;
            surroundings.debug(fmt::format("frame {}: alpha {:.4f}, {:.2f} degrees, {:.2f} s, {} rays",
                                           made.frame, moment.alpha, moment.degrees, made.seconds,
                                           made.rays));
        });
    if (bad > 0)
        surroundings.warn(fmt::format("{} samples were not finite and were left out; please report it", bad));
    if (!surroundings.quiet) {
        fmt::print("frames        {} made, {:.2f} s each; {} kept\n", open.size(),
                   watch.seconds() / static_cast<double>(open.size()),
                   static_cast<std::size_t>(sequence.last - sequence.first + 1) - open.size());
    }
}

/// Makes a video of finished frames.
void encode(const std::vector<fs::path>& frames, double fps, const fs::path& video,
            const Progress& progress) {
    std::optional<VideoEncoder> encoder;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const VideoFrame frame = video_frame(render::read_image(frames[i]).image);
        if (!encoder) encoder.emplace(std::vector{video}, frame.width, frame.height, fps);
        encoder->add(frame);
        progress("video", static_cast<double>(i) / static_cast<double>(frames.size()));
    }
    encoder->finish();
}

/// Makes the video unless it is up to date. A text file beside the frames tells what it was made of.
void make_video(const TurntableArguments& arguments, const TurntableTargets& targets,
                turntable::Sequence sequence, const Surroundings& surroundings) {
    sequence.first = 0;
    sequence.last = arguments.timeline.frames - 1;
    const std::size_t open = turntable::open_frames(sequence).size();
    if (open > 0) {
        if (!surroundings.quiet) {
            fmt::print("{}: made when the other {} of the {} frames are there\n", targets.video.string(),
                       open, sequence.files.size());
        }
        return;
    }
    if (!has_ffmpeg()) {
        throw IoError(
            fmt::format("{}: not made, since there is no ffmpeg; install it (apt-get install ffmpeg) "
                        "and run the same command again: the frames are in {}",
                        targets.video.string(), targets.pattern.parent_path().string()));
    }
    const fs::path record = targets.pattern.parent_path() / (targets.video.filename().string() + ".txt");
    const auto state = [&] {
        return fmt::format("{}\n{} frames at {} fps, {}\n{}\n", sequence.inputs(0), sequence.files.size(),
                           arguments.fps, encoder_settings(targets.video),
                           render::content_hash(file_content(targets.video)));
    };
    if (!arguments.redo && fs::exists(targets.video) && fs::exists(record) && file_content(record) == state())
        return;
    surroundings.progress("video", 0);
    encode(sequence.files, arguments.fps, targets.video, surroundings.progress);
    write_file(record, state());
    surroundings.progress("video", 1);
}

}  // namespace

void run(const TurntableArguments& given, const Surroundings& surroundings) {
    TurntableArguments arguments = given;
    if (arguments.target.empty()) arguments.timeline.alpha = 0;
    const TurntableTargets targets = turntable_targets(arguments.out);
    // What can be refused is refused before the work.
    turntable::timeline(arguments.timeline);
    const turntable::StageOptions stage = stage_options(arguments, surroundings.threads);
    turntable::check(stage);
    const turntable::Sequence sequence = turntable_sequence(arguments, stage, targets.pattern);
    make_folder(targets.pattern.parent_path());
    if (!targets.video.empty() && !has_ffmpeg())
        surroundings.warn("there is no ffmpeg: frames will be made, but no video");
    remove_turntable_leftovers(sequence, targets.video);
    set_stop_advice("; the same command again goes on, finished frames are kept");

    std::vector<turntable::OpenFrame> open;
    if (arguments.redo) {
        for (int frame = sequence.first; frame <= sequence.last; ++frame)
            open.push_back({frame, turntable::FrameState::Outdated});
    } else {
        open = turntable::open_frames(sequence);
        for (const turntable::OpenFrame& each : open)
            surroundings.debug(fmt::format("frame {}: {}", each.frame, turntable::words(each.state)));
    }
    if (!open.empty()) {
        make_missing(arguments, stage, sequence, open, surroundings);
    } else if (!surroundings.quiet) {
        fmt::print("frames        all {} are finished and kept\n", sequence.last - sequence.first + 1);
    }
    if (!surroundings.quiet) {
        fmt::print("written       {} ... {}\n",
                   sequence.files[static_cast<std::size_t>(sequence.first)].string(),
                   sequence.files[static_cast<std::size_t>(sequence.last)].string());
    }
    const std::string further = told_of_further_frames(targets.pattern, arguments.timeline.frames);
    if (!further.empty()) surroundings.warn(further);
    if (targets.video.empty()) return;
    make_video(arguments, targets, sequence, surroundings);
    if (!surroundings.quiet && fs::exists(targets.video))
        fmt::print("              {}\n", targets.video.string());
}

}  // namespace automorph::program
