#pragma once

#include "render/figure/progress.h"
#include "render/program/arguments.h"
#include "render/program/log.h"

/// The subcommands as functions. Each prints its findings on stdout unless `quiet`.
namespace automorph::program {

struct Surroundings {
    bool quiet = false;
    int threads = 0;    ///< of the path tracer; 0: all
    Progress progress;  ///< may be empty
    Log log = {};       ///< may be empty

    void warn(const std::string& line) const {
        if (log) log(LogLevel::Warning, line);
    }
    void debug(const std::string& line) const {
        if (log) log(LogLevel::Debug, line);
    }
};

/// @throws Error of any kind; nothing half-written is left on disk
void run(const FigureArguments& arguments, const Surroundings& surroundings);
void run(const MorphArguments& arguments, const Surroundings& surroundings);
void run(const TurntableArguments& arguments, const Surroundings& surroundings);
void run(const EllipsoidArguments& arguments, const Surroundings& surroundings);
void run(const StarArguments& arguments, const Surroundings& surroundings);
void run(const HeadArguments& arguments, const Surroundings& surroundings);
void run(const ConfigArguments& arguments, const Surroundings& surroundings);

/// Returns the status to exit with, a DiffStatus; throws nothing.
int run(const DiffArguments& arguments, const Surroundings& surroundings) noexcept;
/// Returns the status to exit with: 1 if a mesh cannot be read or morphed.
int run(const InfoArguments& arguments, const Surroundings& surroundings);

}  // namespace automorph::program
