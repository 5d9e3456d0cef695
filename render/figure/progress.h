#pragma once

#include <functional>
#include <string>

namespace automorph {

/// Called while something takes time: what is being done, and the finished fraction in [0, 1]. A task begins
/// with its first call and ends with the call at 1. Never called from two threads at once. May be empty.
using Progress = std::function<void(const std::string& task, double fraction)>;

}  // namespace automorph
