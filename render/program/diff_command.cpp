#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <exception>
#include <map>
#include <new>
#include <system_error>

#include "morph/mesh/errors.h"
#include "morph/mesh/write_file.h"
#include "render/program/commands.h"
#include "render/program/diff_report.h"
#include "render/program/outputs.h"
#include "render/program/picture_diff.h"

namespace automorph::program {
namespace {

namespace fs = std::filesystem;

/// A picture in both folders; one of the files may be missing.
struct Pair {
    std::string name;
    fs::path golden, found;
    bool has_golden = false, has_found = false;
};

/// OpenImageIO's messages may have several.
std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

/// The extension in lower case.
std::string kind_of(const fs::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

bool is_picture(const fs::path& file) {
    const std::string kind = kind_of(file);
    return kind == ".exr" || kind == ".png";
}

/// Paths of the pictures in a folder and below, relative to it; not those that are hidden by a dot.
std::vector<fs::path> pictures_in(const fs::path& folder) {
    std::vector<fs::path> result;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file() && is_picture(entry.path()) &&
            entry.path().filename().string().front() != '.')
            result.push_back(entry.path().lexically_relative(folder));
    }
    return result;
}

bool is_folder(const fs::path& path) {
    std::error_code ignored;
    return fs::is_directory(path, ignored);
}

std::vector<Pair> pairs_of(const DiffArguments& arguments) {
    std::error_code ignored;
    if (fs::equivalent(arguments.golden, arguments.found, ignored)) {
        throw IoError(fmt::format("{}: given as golden and as new; a picture is always the same as itself",
                                  arguments.golden.string()));
    }
    const bool folders = is_folder(arguments.found);
    if (is_folder(arguments.golden) != folders &&
        (fs::exists(arguments.golden, ignored) || !arguments.accept)) {
        throw IoError(fmt::format("{} and {}: give two files that exist, or two folders",
                                  arguments.golden.string(), arguments.found.string()));
    }
    if (!folders) {
        return {{arguments.found.string(), arguments.golden, arguments.found,
                 fs::exists(arguments.golden, ignored), fs::exists(arguments.found, ignored)}};
    }
    std::map<fs::path, Pair> pairs;  // ordered by path
    const auto entry = [&](const fs::path& path) -> Pair& {
        Pair& pair = pairs[path];
        pair.name = path.string();
        pair.golden = arguments.golden / path;
        pair.found = arguments.found / path;
        return pair;
    };
    if (is_folder(arguments.golden)) {
        for (const fs::path& path : pictures_in(arguments.golden)) entry(path).has_golden = true;
    }
    for (const fs::path& path : pictures_in(arguments.found)) entry(path).has_found = true;
    if (pairs.empty()) {
        throw IoError(fmt::format("{} and {}: there is no .exr or .png file in them",
                                  arguments.golden.string(), arguments.found.string()));
    }
    std::vector<Pair> result;
    for (const auto& [path, pair] : pairs) result.push_back(pair);
    return result;
}

PictureDiff diff_pair(const Pair& pair, const DiffArguments& arguments, double false_alarm_rate) {
    PictureDiff diff;
    if (pair.has_golden && pair.has_found) {
        diff = diff_pictures(pair.golden, pair.found, arguments, false_alarm_rate);
    } else if (!pair.has_found && !pair.has_golden) {
        diff.reason =
            fmt::format("{} and {}: there are no such files", pair.golden.string(), pair.found.string());
    } else if (!pair.has_found) {
        diff.reason =
            fmt::format("{}: missing; there is a golden {}", pair.found.string(), pair.golden.string());
    } else {
        diff.reason = fmt::format("{}: there is no golden {}; --accept makes it one", pair.found.string(),
                                  pair.golden.string());
    }
    diff.name = pair.name;
    diff.reason = one_line(diff.reason);
    return diff;
}

void write_pictures(const std::vector<Pair>& pairs, const std::vector<PictureDiff>& diffs,
                    const DiffArguments& arguments) {
    const bool folders = is_folder(arguments.found);
    const auto file_in = [&](const fs::path& asked, const std::string& name) {
        return asked.empty() || !folders ? asked : asked / (name + ".png");
    };
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const fs::path heatmap = file_in(arguments.heatmap, pairs[i].name),
                       side_by_side = file_in(arguments.side_by_side, pairs[i].name);
        if (diffs[i].status == DiffStatus::CannotCompare ||
            (folders && diffs[i].status == DiffStatus::Same)) {
            // Those of an earlier run would seem to be of this one.
            for (const fs::path& file : {heatmap, side_by_side}) {
                std::error_code ignored;
                if (fs::is_regular_file(file, ignored)) fs::remove(file, ignored);
            }
            continue;
        }
        write_diff_pictures(diffs[i], pairs[i].golden, pairs[i].found, heatmap, side_by_side);
    }
}

void copy_over(const fs::path& from, const fs::path& to) {
    make_folder(to.parent_path());
    write_file(to, file_content(from));
}

/// A golden is a copy of a new picture, so its name has to tell what is in it.
void check_kinds(const DiffArguments& arguments) {
    if (is_folder(arguments.found) || kind_of(arguments.golden) == kind_of(arguments.found)) return;
    throw IoError(fmt::format("{}: cannot be copied over {}: --accept takes files of the same kind",
                              arguments.found.string(), arguments.golden.string()));
}

bool is_to_be_copied(const Pair& pair, const PictureDiff& diff) {
    return pair.has_found && diff.status != DiffStatus::Same;
}

/// Replaces the goldens that differ. All new pictures are read before the first golden is touched.
void accept(const std::vector<Pair>& pairs, const std::vector<PictureDiff>& diffs, DiffMode mode,
            bool quiet) {
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (!pairs[i].has_found && pairs.size() == 1) throw IoError(diffs[i].reason);
        if (is_to_be_copied(pairs[i], diffs[i])) check_new_golden(pairs[i].found, mode);
    }
    int copied = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const Pair& pair = pairs[i];
        if (is_to_be_copied(pair, diffs[i])) {
            copy_over(pair.found, pair.golden);
            ++copied;
            if (!quiet)
                fmt::print("{} {}\n", pair.has_golden ? "replaced " : "added    ", pair.golden.string());
        } else if (!pair.has_found && !quiet) {
            fmt::print("kept      {}, which is not among the new pictures\n", pair.golden.string());
        }
    }
    if (!quiet) fmt::print("accepted {} of {} pictures\n", copied, pairs.size());
}

DiffStatus diff(const DiffArguments& arguments, bool quiet) {
    const std::vector<Pair> pairs = pairs_of(arguments);
    if (arguments.accept) check_kinds(arguments);
    check_outputs({arguments.heatmap, arguments.side_by_side, arguments.report},
                  {arguments.golden, arguments.found});
    const auto compared = static_cast<double>(
        std::count_if(pairs.begin(), pairs.end(), [](const Pair& p) { return p.has_golden && p.has_found; }));
    const double rate = arguments.statistical.false_alarm_rate / std::max(1.0, compared);
    std::vector<PictureDiff> diffs;
    for (const Pair& pair : pairs) diffs.push_back(diff_pair(pair, arguments, rate));

    if (!quiet && !arguments.accept) fmt::print("{}{}", diff_verdict(diffs, arguments), diff_table(diffs));
    if (!arguments.accept) {
        for (const PictureDiff& each : diffs) {
            if (!each.reason.empty()) fmt::print(stderr, "automorph: {}\n", each.reason);
        }
    }
    write_pictures(pairs, diffs, arguments);
    if (!arguments.report.empty()) {
        make_folder(arguments.report.parent_path());
        write_file(arguments.report, diff_json(diffs, arguments));
    }
    if (!arguments.accept) return status_of(diffs);
    accept(pairs, diffs, arguments.mode, quiet);
    return DiffStatus::Same;
}

}  // namespace

int run(const DiffArguments& arguments, const Surroundings& surroundings) noexcept {
    // Any failure has to be told from "different", whose status is that of other commands' errors.
    try {
        const DiffStatus status = diff(arguments, surroundings.quiet);
        if (std::fflush(stdout) == 0) return static_cast<int>(status);
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "automorph: out of memory\n");
    } catch (const std::exception& error) {
        fmt::print(stderr, "automorph: {}\n", one_line(error.what()));
    }
    return static_cast<int>(DiffStatus::CannotCompare);
}

}  // namespace automorph::program
