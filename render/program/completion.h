#pragma once

#include <string>

#include "render/program/command_tree.h"

namespace automorph::program {

/// A script that completes commands, options, their values and file names in bash.
std::string bash_completion(const CommandEntry& program);

/// The same for zsh, through its emulation of bash's completion.
std::string zsh_completion(const CommandEntry& program);

/// The same for fish 3 and later, in its own terms: with what each option means.
std::string fish_completion(const CommandEntry& program);

}  // namespace automorph::program
