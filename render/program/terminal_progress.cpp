#include "render/program/terminal_progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "render/figure/progress.h"

namespace automorph::program {
namespace {

constexpr std::chrono::milliseconds kRedraw(100);  // of the bar
constexpr std::chrono::seconds kLines(5);          // between the lines of a log

/// ", detail, 12 s left"
std::string remarks(double fraction, double seconds, const std::string& detail) {
    std::string text = detail.empty() ? "" : ", " + detail;
    // Extrapolating from the first instants would only frighten.
    constexpr double kKnownAfter = 0.02;
    if (fraction > kKnownAfter && fraction < 1 && seconds > 1)
        text += fmt::format(", {} left", duration_text(std::ceil(seconds * (1 - fraction) / fraction)));
    return text;
}

double percent(double fraction) {
    return std::floor(100 * std::clamp(fraction, 0.0, 1.0));
}

/// Of the terminal, if that is known.
std::optional<std::size_t> columns() {
    winsize size{};
    if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 2) return std::nullopt;
    return size.ws_col;
}

/// What is redrawn: cut to the terminal's width, as what wraps cannot be. A narrow one has no room for the
/// bar.
std::string drawn(const std::string& task, double fraction, double seconds, const std::string& detail) {
    constexpr std::size_t kNarrow = 60;
    const std::optional<std::size_t> width = columns();
    if (!width) return progress_bar(task, fraction, seconds, detail);
    const auto text = *width < kNarrow ? progress_line : progress_bar;
    return cut_to_columns(text(task, fraction, seconds, detail), *width - 1);
}

}  // namespace

std::string cut_to_columns(const std::string& text, std::size_t columns) {
    std::size_t used = 0, end = 0;
    while (end < text.size()) {
        const auto first = static_cast<unsigned char>(text[end]);
        // Of UTF-8, what begins so are the scripts of East Asia and pictographs.
        used += first >= 0xe3 ? 2 : 1;
        if (used > columns) break;
        do ++end;
        while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xc0u) == 0x80u);
    }
    return text.substr(0, end);
}

std::string duration_text(double seconds) {
    const auto whole = static_cast<long long>(std::llround(std::max(0.0, seconds)));
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
    return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

std::string progress_bar(const std::string& task, double fraction, double seconds,
                         const std::string& detail) {
    if (fraction == Progress::kUnknown) return progress_line(task, fraction, seconds, detail);
    constexpr int kWidth = 20;
    const int full = static_cast<int>(std::floor(std::clamp(fraction, 0.0, 1.0) * kWidth));
    return fmt::format("[{}{}] {:3.0f} %  {}{}", std::string(static_cast<std::size_t>(full), '#'),
                       std::string(static_cast<std::size_t>(kWidth - full), '.'), percent(fraction), task,
                       remarks(fraction, seconds, detail));
}

std::string progress_line(const std::string& task, double fraction, double seconds,
                          const std::string& detail) {
    if (fraction == Progress::kUnknown) return detail.empty() ? task : task + ": " + detail;
    return fmt::format("{}: {:.0f} %{}", task, percent(fraction), remarks(fraction, seconds, detail));
}

void TerminalProgress::operator()(const std::string& task, double fraction, const std::string& detail) {
    const Clock::time_point now = Clock::now();
    const bool is_terminal = ::isatty(STDERR_FILENO) != 0;
    if (task != task_) {
        task_ = task;
        began_ = now;
        shown_ = is_terminal ? Clock::time_point{} : now;
    }
    const double seconds = std::chrono::duration<double>(now - began_).count();
    if (fraction >= 1) {
        clear();
        fmt::print(stderr, "{}: {:.1f} s\n", task, seconds);
        task_.clear();
    } else if (is_terminal && (fraction == Progress::kUnknown || now - shown_ > kRedraw)) {
        fmt::print(stderr, "\r{}\x1b[K", drawn(task, fraction, seconds, detail));
        std::fflush(stderr);
        on_screen_ = true;
        shown_ = now;
    } else if (!is_terminal && now - shown_ > kLines) {
        fmt::print(stderr, "{}\n", progress_line(task, fraction, seconds, detail));
        shown_ = now;
    }
}

void TerminalProgress::clear() {
    if (on_screen_) fmt::print(stderr, "\r\x1b[K");
    on_screen_ = false;
}

}  // namespace automorph::program
