#pragma once

#include <chrono>
#include <string>

namespace automorph::program {

/// The beginning of UTF-8 text that takes no more columns of a terminal; no character is cut.
std::string cut_to_columns(const std::string& text, std::size_t columns);

/// Shows progress on stderr: a bar that is redrawn on a terminal; elsewhere a line per finished task, and one
/// every few seconds of a long one.
class TerminalProgress {
public:
    /// For a Progress; see there.
    void operator()(const std::string& task, double fraction, const std::string& detail = {});

    /// Leaves the terminal with an empty line to write on; for use before other output.
    void clear();

private:
    using Clock = std::chrono::steady_clock;

    std::string task_;
    Clock::time_point began_, shown_;
    bool on_screen_ = false;
};

/// "[######..............]  30 %  task, detail, 12 s left"; without the time while it cannot be told.
std::string progress_bar(const std::string& task, double fraction, double seconds,
                         const std::string& detail = {});

/// "task: 30 %, detail, 12 s left", for logs. "task: detail" where the fraction is unknown, here and above.
std::string progress_line(const std::string& task, double fraction, double seconds,
                          const std::string& detail = {});

/// "48 s", "12 min 5 s", "3 h 10 min".
std::string duration_text(double seconds);

}  // namespace automorph::program
