#pragma once

#include <string>
#include <vector>

namespace automorph {

/// "; did you mean 'x'?" where one of the names is near enough to be a misspelling, or one begins the other.
std::string suggestion(const std::string& name, const std::vector<std::string>& names);

}  // namespace automorph
