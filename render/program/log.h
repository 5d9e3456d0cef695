#pragma once

#include <functional>
#include <string>

namespace automorph::program {

/// What is told; each level tells what those before it do, too.
enum class LogLevel {
    Error,    ///< why a command failed
    Warning,  ///< what makes a result doubtful
    Info,     ///< findings and progress
    Debug     ///< how they came about
};

/// Takes one line without its end. May be empty.
using Log = std::function<void(LogLevel level, const std::string& line)>;

}  // namespace automorph::program
