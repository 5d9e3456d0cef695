#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/compare/comparison.h"
#include "render/compare/statistical.h"
#include "render/program/diff_arguments.h"

namespace automorph::program {

/// What was found about one picture.
struct PictureDiff {
    std::string name;  ///< path in both folders, or that of the new file
    DiffStatus status = DiffStatus::CannotCompare;
    std::string reason;                              ///< why it cannot be compared: one line
    DiffMode mode = DiffMode::Auto;                  ///< the one used; Auto if none was
    render::Comparison comparison;                   ///< unless it cannot be compared
    std::vector<std::string> channels;               ///< names of the compared channels
    std::optional<render::Sensitivity> sensitivity;  ///< of a statistical comparison
};

/// Compares two files.
/// @param false_alarm_rate of this picture
PictureDiff diff_pictures(const std::filesystem::path& golden, const std::filesystem::path& found,
                          const DiffArguments& arguments, double false_alarm_rate);

/// Whether a picture can be read as a golden of this mode has to be.
/// @throws IoError if not
void check_new_golden(const std::filesystem::path& file, DiffMode mode);

/// Writes the PNGs asked for (empty names: none), folders included.
/// @throws IoError
void write_diff_pictures(const PictureDiff& diff, const std::filesystem::path& golden,
                         const std::filesystem::path& found, const std::filesystem::path& heatmap,
                         const std::filesystem::path& side_by_side);

}  // namespace automorph::program
