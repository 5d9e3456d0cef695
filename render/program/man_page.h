#pragma once

#include <string>

#include "render/program/command_tree.h"

namespace automorph::program {

/// automorph(1) as troff source: every command with its options, then the help topics.
std::string man_page(const CommandEntry& program, const std::string& version);

}  // namespace automorph::program
