#pragma once

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "tests/render/temporary_folder.h"

// The built program as a user runs it, and what it leaves.

inline std::string content(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

inline int lines_in(const std::string& text) {
    return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

inline std::set<std::string> names_in(const std::filesystem::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        names.insert(entry.path().filename().string());
    return names;
}

struct Run {
    int status = -1;
    std::string out, err;
};

// Runs `automorph ARGUMENTS` with `folder` as working directory.
inline Run run_program(const TemporaryFolder& folder, const std::string& arguments) {
    const TemporaryFolder logs;
    const std::string command = "cd '" + folder.path().string() + "' && '" AUTOMORPH_PROGRAM "' " +
                                arguments + " >'" + (logs / "out").string() + "' 2>'" +
                                (logs / "err").string() + "' </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(logs / "out"), content(logs / "err")};
}
