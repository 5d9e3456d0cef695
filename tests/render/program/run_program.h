#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/files.h"

// The built program as a user runs it, and what it leaves.

struct Run {
    int status = -1;
    std::string out, err;
};

// Runs `automorph ARGUMENTS` with `folder` as working directory, which `input` may lie in.
inline Run run_program(const TemporaryFolder& folder, const std::string& arguments,
                       const std::string& input = "/dev/null") {
    const TemporaryFolder logs;
    const std::string command = "cd '" + folder.path().string() + "' && '" AUTOMORPH_PROGRAM "' " +
                                arguments + " >'" + (logs / "out").string() + "' 2>'" +
                                (logs / "err").string() + "' <" + input;
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(logs / "out"), content(logs / "err")};
}
