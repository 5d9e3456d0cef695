#pragma once

#include <string>

namespace automorph::program {

/// "0.1.0"
std::string version();

/// "automorph 0.1.0", then the compiler and the libraries it was built with.
std::string version_text();

}  // namespace automorph::program
