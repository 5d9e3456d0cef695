#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "render/figure/progress.h"
#include "render/figure/stopwatch.h"

namespace automorph {

/// Tells how far a task of several pictures is: which one is at work, samples and rays per second.
class PictureProgress {
public:
    /// @param one  what a picture is called, e.g. "frame"; @param count  of those to make
    PictureProgress(const Progress& progress, std::string task, std::string one, std::size_t count)
        : progress_(progress), task_(std::move(task)), one_(std::move(one)), count_(count) {}

    /// Begins the next picture. Returns what is to be told its finished fraction.
    /// @param number  its name; @param most  samples that it takes at most
    std::function<void(double)> begin(std::size_t number, double most) {
        const double samples = done_ > 0 ? samples_ / static_cast<double>(done_) : most;
        const std::string place = fmt::format("{} {} ({} of {})", one_, number, done_ + 1, count_);
        const auto tell = [this, place, samples](double fraction) {
            if (!progress_) return;
            // The task is done when its last file is written, not before.
            const double done =
                (static_cast<double>(done_) + std::min(fraction, 0.999)) / static_cast<double>(count_);
            progress_(task_, done, place + rates(fraction * samples));
        };
        tell(0);
        return tell;
    }

    /// The picture is there. @param samples, rays  that it took
    void end(std::uint64_t samples, std::uint64_t rays) {
        ++done_;
        samples_ += static_cast<double>(samples);
        rays_ += static_cast<double>(rays);
    }

    /// The task is done.
    void finish() const { progress_(task_, 1); }

private:
    static std::string rate_text(double per_second) {
        return per_second >= 1e5 ? fmt::format("{:.1f} M", 1e-6 * per_second)
                                 : fmt::format("{:.1f} k", 1e-3 * per_second);
    }

    /// @param open  samples of the picture at work
    std::string rates(double open) const {
        constexpr double kKnownAfter = 0.5;  // seconds
        const double seconds = watch_.seconds(), taken = samples_ + open;
        if (seconds < kKnownAfter) return "";
        std::string text = fmt::format(", {} samples/s", rate_text(taken / seconds));
        // Rays are counted when a picture is done.
        if (samples_ > 0) text += fmt::format(", {} rays/s", rate_text(rays_ / samples_ * taken / seconds));
        return text;
    }

    const Progress& progress_;
    std::string task_, one_;
    std::size_t count_, done_ = 0;
    double samples_ = 0, rays_ = 0;  // of the pictures before
    Stopwatch watch_;
};

}  // namespace automorph
