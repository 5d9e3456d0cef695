#pragma once

#include <filesystem>
#include <string>

namespace automorph {

/// Writes a file aside, in the same folder, and renames it, so that a reader never sees half of it.
/// @throws IoError naming the file and the system's reason; nothing is left behind
void write_text_file(const std::filesystem::path& file, const std::string& text);

/// Makes the folder and those above it.
/// @throws IoError naming the folder and the system's reason
void make_folder(const std::filesystem::path& folder);

}  // namespace automorph
