#pragma once

#include <filesystem>
#include <string>

#include "morph/mesh/mesh.h"

namespace automorph::program {

/// The name of frame `index` of `count`: "m_.ply" gives "m_007.ply"; four digits and more where `count` needs
/// them.
std::filesystem::path numbered(const std::filesystem::path& pattern, int index, int count);

/// Names a sequence's frames from `count` on that an earlier, longer one left: "m_005.ply and 3 more lie
/// there, too, of an earlier sequence: not among these 5 frames". Empty if there are none.
std::string told_of_further_frames(const std::filesystem::path& pattern, int count);

/// Points as CSV: a header "x,y,z", then one line per row in the shortest form that reads back to the same
/// double; "nan" where there is none.
std::string points_csv(const Points& points);

}  // namespace automorph::program
