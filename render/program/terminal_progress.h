#pragma once

#include <chrono>
#include <string>

namespace automorph::program {

/// Shows progress on stderr: a bar that is redrawn on a terminal, one line per finished task elsewhere.
class TerminalProgress {
public:
    /// For a Progress; see there.
    void operator()(const std::string& task, double fraction);

    /// Leaves the terminal with an empty line to write on; for use before other output.
    void clear();

private:
    using Clock = std::chrono::steady_clock;

    std::string task_;
    Clock::time_point began_, drawn_;
    bool on_screen_ = false;
};

/// "[######..............]  30 %  task, 12 s left"; without the time while it cannot be told.
std::string progress_bar(const std::string& task, double fraction, double seconds);

}  // namespace automorph::program
