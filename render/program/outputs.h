#pragma once

#include <filesystem>
#include <vector>

namespace automorph::program {

/// Whether files can be written without harm; empty paths are skipped.
/// @throws IoError  two that are written are the same, or one is also read
void check_outputs(const std::vector<std::filesystem::path>& written,
                   const std::vector<std::filesystem::path>& read);

}  // namespace automorph::program
