#pragma once

#include <filesystem>
#include <string_view>

namespace automorph {

/// Writes a file aside, in the same folder, and renames it, so that a reader never sees half of it.
/// @throws IoError naming the file and the system's reason; nothing is left behind, and an existing file
/// stays
///         as it was
void write_file(const std::filesystem::path& file, std::string_view bytes);

}  // namespace automorph
