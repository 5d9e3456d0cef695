#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "morph/mesh/errors.h"
#include "morph/mesh/write_file.h"
#include "render/figure/clips.h"
#include "render/figure/figure.h"
#include "render/figure/folder_files.h"
#include "render/program/commands.h"
#include "render/program/figure_plan.h"
#include "render/program/summary.h"

namespace automorph::program {
namespace {

struct Job {
    FigureConfig config;
    FigureOptions options;
    std::filesystem::path folder;
};

FigureOptions options_of(const FigureArguments& arguments, const Surroundings& surroundings) {
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
    return options;
}

/// Reads all configs and settles their folders before anything is computed.
std::vector<Job> jobs_of(const FigureArguments& arguments, const Surroundings& surroundings) {
    const FigureOptions options = options_of(arguments, surroundings);
    std::vector<Job> jobs;
    std::map<std::filesystem::path, std::filesystem::path> config_of_folder;
    for (const std::filesystem::path& file : arguments.configs) {
        Job job{load_config(file, arguments.overrides), options, {}};
        apply_quality(arguments.quality, job.config);
        check_selections(job.config, job.options);
        job.folder = job.config.output;
        if (arguments.out)
            job.folder =
                arguments.configs.size() > 1 ? *arguments.out / job.config.file.stem() : *arguments.out;
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

/// "a, b, c and 9 more"
std::string some_of(const FileNames& names) {
    constexpr std::size_t kTold = 3;
    const auto end = std::next(names.begin(), static_cast<std::ptrdiff_t>(std::min(kTold, names.size())));
    std::string text = fmt::format("{}", fmt::join(names.begin(), end, ", "));
    if (names.size() > kTold) text += fmt::format(" and {} more", names.size() - kTold);
    return text;
}

/// What an earlier run made in the folder and this one does not would look like a part of this figure; where
/// only some rows, cells or frames are asked for, the others stay.
void settle_other_files(const Job& job, const FileNames& made, const Surroundings& surroundings) {
    const FileNames others = other_files(job.folder, made);
    if (others.empty()) return;
    const bool is_part = !part_text(job.options).empty();
    if (!is_part) remove_files(job.folder, others);
    if (surroundings.quiet) return;
    fmt::print("\n{} {} of an earlier run{}\n", is_part ? "kept" : "removed", some_of(others),
               is_part ? "; page and sheet show this run only" : "");
}

}  // namespace

void run(const FigureArguments& arguments, const Surroundings& surroundings) {
    for (const Job& job : jobs_of(arguments, surroundings)) {
        if (arguments.dry_run) {
            fmt::print("{}", figure_plan(job.config, job.options, job.folder));
            continue;
        }
        Figure figure = render_figure(job.config, job.options);
        const FileNames made = figure_files(job.config, job.options);
        list_files(job.folder, made);
        make_clips(job.config, job.options, job.folder, figure);
        write_figure(job.config, figure, job.folder);
        if (!surroundings.quiet) print_summary(figure);
        settle_other_files(job, made, surroundings);
        if (surroundings.quiet) {
            for (const Report& report : figure.morphs) warn_of_doubts(report, surroundings);
            continue;
        }
        if (!figure.no_videos.empty()) fmt::print("\nno videos: {}\n", figure.no_videos);
        fmt::print(
            "\n{}: meshes {:.1f} s, morphs {:.1f} s, checks {:.1f} s, pictures {:.1f} s, videos {:.1f} s\n",
            (job.folder / "sheet.png").string(), figure.load_seconds, figure.morph_seconds,
            figure.check_seconds, figure.render_seconds, figure.video_seconds);
        fmt::print("{}\n", (job.folder / "index.html").string());
    }
}

}  // namespace automorph::program
