#pragma once

#include <sys/resource.h>

#include <chrono>
#include <string>
#include <utility>

#include "morph/report.h"

namespace automorph {

/// Tells of a stage when it begins, and adds its wall time and the process's peak memory to a report when it
/// goes out of scope.
class StageClock {
public:
    StageClock(Report& report, std::string name) : report_(report), name_(std::move(name)) {
        if (report_.on_stage) report_.on_stage(name_);
    }
    StageClock(const StageClock&) = delete;
    StageClock& operator=(const StageClock&) = delete;

    ~StageClock() {
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
        rusage usage{};
        getrusage(RUSAGE_SELF, &usage);
        report_.stages.push_back({name_, elapsed.count(), static_cast<double>(usage.ru_maxrss) / 1024.0});
    }

private:
    Report& report_;
    std::string name_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace automorph
