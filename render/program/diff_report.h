#pragma once

#include <string>
#include <vector>

#include "render/program/diff_arguments.h"
#include "render/program/picture_diff.h"

namespace automorph::program {

/// The worst of all pictures: one that cannot be compared, else one that differs.
DiffStatus status_of(const std::vector<PictureDiff>& diffs);

/// One line, ended: what has changed most, or that nothing has.
std::string diff_verdict(const std::vector<PictureDiff>& diffs, const DiffArguments& arguments);

/// The tests of one picture, or one line per picture. Ended; empty where there is nothing to show.
std::string diff_table(const std::vector<PictureDiff>& diffs);

/// All of it. Numbers that are not finite become null.
std::string diff_json(const std::vector<PictureDiff>& diffs, const DiffArguments& arguments);

}  // namespace automorph::program
