#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <system_error>
#include <vector>

#include "morph/export/write_glb.h"
#include "morph/frame_check.h"
#include "morph/mesh/errors.h"
#include "morph/mesh/io.h"
#include "morph/mesh/write_file.h"
#include "morph/morph.h"
#include "render/program/commands.h"
#include "render/program/frame_files.h"
#include "render/program/outputs.h"
#include "render/program/summary.h"

namespace automorph::program {
namespace {

bool is_folder(const std::filesystem::path& file) {
    std::error_code error;
    return std::filesystem::is_directory(file, error);
}

/// Of the numbered frames only those that could be one of the inputs.
std::vector<std::filesystem::path> written_files(const MorphArguments& arguments) {
    std::vector<std::filesystem::path> files{arguments.correspondence, arguments.report};
    if (is_glb_file(arguments.out)) files.push_back(arguments.out);
    if (!is_mesh_file(arguments.out)) return files;
    for (int i = 0; i < arguments.frames; ++i) {
        const std::filesystem::path frame = numbered(arguments.out, i, arguments.frames);
        if (frame.filename() == arguments.source.filename() ||
            frame.filename() == arguments.target.filename())
            files.push_back(frame);
    }
    return files;
}

/// What can be refused is refused before the work.
void prepare_outputs(const MorphArguments& arguments) {
    if (!arguments.out.empty() && !is_folder(arguments.out) && !is_mesh_file(arguments.out) &&
        !is_glb_file(arguments.out)) {
        throw IoError(fmt::format(
            "{}: a morph is written as .glb (one animated file), or as numbered .off, .obj, .ply or .stl",
            arguments.out.string()));
    }
    check_outputs(written_files(arguments), {arguments.source, arguments.target});
    for (const auto& file : {arguments.out, arguments.correspondence, arguments.report}) {
        if (is_folder(file))
            throw IoError(fmt::format("{}: is a folder; give the name of a file", file.string()));
        if (file.has_parent_path()) make_folder(file.parent_path());
    }
}

void write_frames(const MorphArguments& arguments, const Morph& result, const Surroundings& surroundings) {
    for (int i = 0; i < arguments.frames; ++i) {
        const double alpha = static_cast<double>(i) / (arguments.frames - 1);
        write_mesh(numbered(arguments.out, i, arguments.frames), result.mesh(alpha, arguments.interpolation));
        surroundings.progress("frames", static_cast<double>(i + 1) / arguments.frames);
    }
    const std::string further = told_of_further_frames(arguments.out, arguments.frames);
    if (!further.empty()) surroundings.warn(further);
}

/// Writes what --out asks for; returns what was written, for the reader.
std::string write_morph(const MorphArguments& arguments, const Morph& result,
                        const Surroundings& surroundings) {
    if (is_glb_file(arguments.out)) {
        write_glb(arguments.out, result.triangles(), result.endpoints(),
                  {.animation = {arguments.interpolation, arguments.seconds, arguments.ping_pong},
                   .up = arguments.up,
                   .name = arguments.source.stem().string() + " to " + arguments.target.stem().string()});
        return arguments.out.string();
    }
    write_frames(arguments, result, surroundings);
    return fmt::format("{} ... {}", numbered(arguments.out, 0, arguments.frames).string(),
                       numbered(arguments.out, arguments.frames - 1, arguments.frames).string());
}

}  // namespace

void run(const MorphArguments& arguments, const Surroundings& surroundings) {
    prepare_outputs(arguments);
    const InputMesh source = load_mesh(arguments.source.string()),
                    target = load_mesh(arguments.target.string());
    MorphOptions options = arguments.options;
    options.on_stage = [&](const std::string& stage) {
        surroundings.progress("morph", Progress::kUnknown, stage);
    };
    const Morph result = morph(source, target, options);
    surroundings.progress("morph", 1.0);
    // Frames that somebody is going to see are looked at.
    const bool seen = !arguments.out.empty() || !arguments.report.empty();
    const Report report = seen ? report_with_frames(result, arguments.interpolation) : result.report();
    print_morph(report, surroundings);
    if (surroundings.quiet) {
        for (std::size_t k = result.report().notes.size(); k < report.notes.size(); ++k)
            surroundings.warn(report.notes[k]);
    }

    std::vector<std::string> written;
    if (!arguments.out.empty()) written.push_back(write_morph(arguments, result, surroundings));
    if (!arguments.correspondence.empty()) {
        write_file(arguments.correspondence, points_csv(result.correspondence()));
        written.push_back(arguments.correspondence.string());
    }
    if (!arguments.report.empty()) {
        write_file(arguments.report, report_json(report));
        written.push_back(arguments.report.string());
    }
    if (surroundings.quiet) return;
    if (written.empty()) written.emplace_back("nothing: give --out, --correspondence or --report");
    fmt::print("written       {}\n", fmt::join(written, "\n              "));
}

}  // namespace automorph::program
