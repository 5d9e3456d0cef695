#include <fmt/format.h>

#include <map>
#include <set>

#include "morph/mesh/errors.h"
#include "morph/mesh/write_file.h"
#include "render/figure/clips.h"
#include "render/figure/figure.h"
#include "render/program/commands.h"
#include "render/program/figure_plan.h"
#include "render/program/summary.h"

namespace automorph::program {
namespace {

struct Job {
    FigureConfig config;
    std::filesystem::path folder;
};

/// Reads all configs and settles their folders before anything is computed.
std::vector<Job> jobs_of(const FigureArguments& arguments) {
    std::vector<Job> jobs;
    std::map<std::filesystem::path, std::filesystem::path> config_of_folder;
    for (const std::filesystem::path& file : arguments.configs) {
        Job job{load_config(file, arguments.overrides), {}};
        apply_quality(arguments.quality, job.config);
        job.folder = job.config.output;
        if (arguments.out)
            job.folder = arguments.configs.size() > 1 ? *arguments.out / file.stem() : *arguments.out;
        const auto [other, is_new] = config_of_folder.emplace(job.folder.lexically_normal(), file);
        if (!is_new) {
            throw ConfigError(fmt::format("{}: writes to {}, as {} does; give them different outputs",
                                          file.string(), job.folder.string(), other->second.string()));
        }
        jobs.push_back(std::move(job));
    }
    if (arguments.dry_run) return jobs;
    for (const Job& job : jobs) {
        make_folder(job.folder);
        remove_leftovers(job.folder,
                         [](const std::string&) { return true; });  // the folder is the figure's own
    }
    return jobs;
}

void print_summary(const Figure& figure) {
    fmt::print("{}", meshes_summary(figure.morphs.front()));
    std::set<std::size_t> told;  // morphs
    std::uint64_t bad = 0;
    for (const FigureRow& row : figure.rows) {
        const bool is_new = told.insert(row.morph).second;
        fmt::print("\nrow {}: {}{}\n", row.number + 1, row.config.label,
                   is_new ? "" : " (a morph above, moved otherwise)");
        if (is_new) fmt::print("{}", morph_summary(figure.morphs[row.morph]));
        for (const std::string& warning : row.warnings) fmt::print("{:<13} {}\n", "note", warning);
        for (const FigureCell& cell : row.cells) bad += cell.bad_samples;
    }
    if (bad > 0) fmt::print("\n{} samples were not finite and left out; please report it\n", bad);
}

}  // namespace

void run(const FigureArguments& arguments, const Surroundings& surroundings) {
    for (const Job& job : jobs_of(arguments)) {
        FigureOptions options;
        options.spp = arguments.spp;
        options.scale = arguments.scale;
        options.denoise = arguments.denoise;
        options.layers = arguments.layers;
        options.threads = surroundings.threads;
        options.progress = surroundings.progress;
        const auto selection = [](const char* flag, const std::string& text) {
            try {
                return text.empty() ? Selection() : Selection(text);
            } catch (const ConfigError& error) {
                throw ConfigError(fmt::format("{} {}", flag, error.what()));
            }
        };
        options.rows = selection("--rows", arguments.rows);
        options.cells = selection("--cells", arguments.cells);
        options.frames = selection("--frames", arguments.frames);
        if (arguments.dry_run) {
            fmt::print("{}", figure_plan(job.config, options, job.folder));
            continue;
        }
        Figure figure = render_figure(job.config, options);
        make_clips(job.config, options, job.folder, figure);
        write_figure(job.config, figure, job.folder);
        if (surroundings.quiet) {
            for (const Report& report : figure.morphs) warn_of_doubts(report, surroundings);
            continue;
        }
        print_summary(figure);
        if (!figure.no_videos.empty()) fmt::print("\nno videos: {}\n", figure.no_videos);
        fmt::print(
            "\n{}: meshes {:.1f} s, morphs {:.1f} s, checks {:.1f} s, pictures {:.1f} s, videos {:.1f} s\n",
            (job.folder / "sheet.png").string(), figure.load_seconds, figure.morph_seconds,
            figure.check_seconds, figure.render_seconds, figure.video_seconds);
        fmt::print("{}\n", (job.folder / "index.html").string());
    }
}

}  // namespace automorph::program
