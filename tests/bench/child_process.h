#pragma once

#include <functional>
#include <string>

namespace automorph::bench {

struct ChildLimits {
    double seconds = 300;
    double memory_gb = 8;  ///< of address space
};

struct ChildResult {
    std::string output;   ///< what the body returned; empty if it did not end
    std::string failure;  ///< how it ended otherwise, in words; empty if it returned
    double seconds = 0, cpu_seconds = 0;
    double peak_memory_mb = 0;
};

/// Runs a body in a process of its own, so that a crash, a hang or a leak of it is a result and not the end.
/// What it prints on stderr is thrown away.
/// @pre no threads have been started yet: a child has only the one that called
ChildResult run_in_child(const std::function<std::string()>& body, const ChildLimits& limits);

}  // namespace automorph::bench
