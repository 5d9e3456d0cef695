#include <fmt/format.h>
#include <tbb/global_control.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <functional>
#include <new>
#include <optional>
#include <string>
#include <type_traits>

#include "morph/mesh/errors.h"
#include "render/program/arguments.h"
#include "render/program/commands.h"
#include "render/program/interrupt.h"
#include "render/program/terminal_progress.h"

namespace {

using namespace automorph;

/// Does what the command line asks for; returns the status to exit with.
int run_program(int count, char** values) {
    program::TerminalProgress terminal;
    try {
        const auto read = program::read_arguments(count, values);
        if (const int* status = std::get_if<int>(&read)) return *status;
        const auto& arguments = std::get<program::Arguments>(read);

        std::optional<tbb::global_control> limit;
        if (arguments.threads > 0) {
            limit.emplace(tbb::global_control::max_allowed_parallelism,
                          static_cast<std::size_t>(arguments.threads));
        }
        program::Surroundings surroundings{arguments.quiet, arguments.threads, {}};
        if (!arguments.quiet) surroundings.progress = std::ref(terminal);
        surroundings.log = [&](program::LogLevel level, const std::string& line) {
            if (level > arguments.log_level) return;
            terminal.clear();
            fmt::print(stderr, "automorph: {}{}\n", level == program::LogLevel::Warning ? "warning: " : "",
                       line);
        };
        return std::visit(
            [&](const auto& command) {
                if constexpr (std::is_void_v<decltype(program::run(command, surroundings))>) {
                    program::run(command, surroundings);
                    return 0;
                } else {
                    return program::run(command, surroundings);
                }
            },
            arguments.command);
    } catch (const Error& error) {
        terminal.clear();
        fmt::print(stderr, "automorph: {}\n", error.what());
    } catch (const std::bad_alloc&) {
        terminal.clear();
        fmt::print(stderr, "automorph: out of memory\n");
    } catch (const std::exception& error) {
        terminal.clear();
        if (std::ferror(stdout) == 0)  // else main() tells
            fmt::print(stderr, "automorph: unexpected error, please report it: {}\n", error.what());
    }
    return 1;
}

}  // namespace

int main(int count, char** values) {
    program::end_on_signals();
    const int status = run_program(count, values);
    // Findings that nobody gets are no success.
    errno = 0;
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
    fmt::print(stderr, "automorph: the output cannot be written: {}\n",
               errno != 0 ? std::strerror(errno) : "the disk may be full");
    return status == 0 ? 1 : status;
}
