#include "render/program/terminal_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace automorph::program {

std::string progress_bar(const std::string& task, double fraction, double seconds) {
    constexpr int kWidth = 20;
    const double clamped = std::clamp(fraction, 0.0, 1.0);
    const int full = static_cast<int>(std::floor(clamped * kWidth));
    std::string text = fmt::format("[{}{}] {:3.0f} %  {}", std::string(static_cast<std::size_t>(full), '#'),
                                   std::string(static_cast<std::size_t>(kWidth - full), '.'),
                                   std::floor(100 * clamped), task);
    // Extrapolating from the first instants would only frighten.
    constexpr double kKnownAfter = 0.02;
    if (clamped > kKnownAfter && clamped < 1 && seconds > 1) {
        text += fmt::format(", {:.0f} s left", std::ceil(seconds * (1 - clamped) / clamped));
    }
    return text;
}

void TerminalProgress::operator()(const std::string& task, double fraction) {
    const Clock::time_point now = Clock::now();
    if (task != task_) {
        task_ = task;
        began_ = now;
        drawn_ = {};
    }
    const double seconds = std::chrono::duration<double>(now - began_).count();
    const bool is_terminal = ::isatty(STDERR_FILENO) != 0;
    if (fraction >= 1) {
        clear();
        fmt::print(stderr, "{}: {:.1f} s\n", task, seconds);
        task_.clear();
    } else if (is_terminal && now - drawn_ > std::chrono::milliseconds(100)) {
        fmt::print(stderr, "\r{}\x1b[K", progress_bar(task, fraction, seconds));
        std::fflush(stderr);
        on_screen_ = true;
        drawn_ = now;
    }
}

void TerminalProgress::clear() {
    if (on_screen_) fmt::print(stderr, "\r\x1b[K");
    on_screen_ = false;
}

}  // namespace automorph::program
