#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace automorph {

/// Writes a file aside, in the same folder, and renames it, so that a reader never sees half of it. A request
/// to stop (write_gate.h) waits until the file is whole. A symbolic link stays one: the file that it names is
/// written. Pipes and devices (/dev/stdout) are written directly.
/// @throws IoError naming the file and the system's reason; nothing is left behind, and an existing file
///         stays as it was
void write_file(const std::filesystem::path& file, std::string_view bytes);

/// A whole file. @throws IoError  it cannot be read
std::string file_content(const std::filesystem::path& file);

/// The file that writing `file` makes or replaces: where symbolic links lead, which need not exist.
/// @throws IoError if they lead nowhere
std::filesystem::path behind_links(const std::filesystem::path& file);

/// Gives a finished file aside its name. A file that it replaces hands on its permissions.
/// @throws IoError  where there is a folder, or a file that is write-protected
void put_in_place(const std::filesystem::path& aside, const std::filesystem::path& place);

/// Makes the folder and those above it; an empty path is the working directory.
/// @throws IoError naming the folder and the system's reason, also where files cannot be made in it
void make_folder(const std::filesystem::path& folder);

/// The name under which `file` is written before it is renamed: `file` with ".<process>-<number>.part" behind
/// it. No other writer on this machine takes it.
std::filesystem::path name_aside(const std::filesystem::path& file);

/// Removes what killed processes of this machine left aside in a folder; a folder that is not there has none.
/// @param is_ours  told the name of a file, whether leftovers of writing it are to go
void remove_leftovers(const std::filesystem::path& folder,
                      const std::function<bool(const std::string& name)>& is_ours);

}  // namespace automorph
