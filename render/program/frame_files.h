#pragma once

#include <filesystem>
#include <string>

#include "morph/mesh/mesh.h"

namespace automorph::program {

/// The name of frame `index` of `count`: "m_.ply" gives "m_007.ply"; four digits and more where `count` needs
/// them.
std::filesystem::path numbered(const std::filesystem::path& pattern, int index, int count);

/// Points as CSV: a header "x,y,z", then one line per row in the shortest form that reads back to the same
/// double; "nan" where there is none.
std::string points_csv(const Points& points);

}  // namespace automorph::program
