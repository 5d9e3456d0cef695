#include "tests/bench/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <new>
#include <system_error>

namespace automorph::bench {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

double seconds(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// The child's life: never returns.
[[noreturn]] void live(const std::function<std::string()>& body, const ChildLimits& limits, int pipe_end) {
    const auto bytes = static_cast<rlim_t>(limits.memory_gb * 1024 * 1024 * 1024);
    const rlimit memory{bytes, bytes}, no_core{0, 0};
    setrlimit(RLIMIT_AS, &memory);
    setrlimit(RLIMIT_CORE, &no_core);
    const int nowhere = open("/dev/null", O_WRONLY);
    if (nowhere >= 0) dup2(nowhere, STDERR_FILENO);
    // The first letter says how it went.
    std::string message;
    try {
        message = "+" + body();
    } catch (const std::bad_alloc&) {
        message = fmt::format("-out of memory ({} GB)", limits.memory_gb);
    } catch (const std::exception& error) {
        message = std::string("-") + error.what();
    }
    for (std::size_t sent = 0; sent < message.size();) {
        const ssize_t count = write(pipe_end, message.data() + sent, message.size() - sent);
        if (count <= 0) _exit(1);
        sent += static_cast<std::size_t>(count);
    }
    _exit(0);
}

/// Reads until the child closes its end. False: time is up.
bool read_all(int pipe_end, double limit, Clock::time_point start, std::string& text) {
    for (;;) {
        const double left = limit - seconds_since(start);
        pollfd waiting{pipe_end, POLLIN, 0};
        if (left <= 0 || poll(&waiting, 1, static_cast<int>(left * 1e3) + 1) == 0) return false;
        char buffer[4096];
        const ssize_t count = read(pipe_end, buffer, sizeof buffer);
        if (count <= 0) return true;
        text.append(buffer, static_cast<std::size_t>(count));
    }
}

}  // namespace

ChildResult run_in_child(const std::function<std::string()>& body, const ChildLimits& limits) {
    int ends[2];
    if (pipe(ends) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
    std::fflush(nullptr);
    const auto start = Clock::now();
    const pid_t child = fork();
    if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
    if (child == 0) {
        close(ends[0]);
        live(body, limits, ends[1]);
    }
    close(ends[1]);
    std::string text;
    const bool in_time = read_all(ends[0], limits.seconds, start, text);
    close(ends[0]);
    if (!in_time) kill(child, SIGKILL);
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);

    ChildResult result;
    result.seconds = seconds_since(start);
    result.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    result.peak_memory_mb = static_cast<double>(usage.ru_maxrss) / 1024.0;
    if (!in_time) {
        result.failure = fmt::format("not done after {} s", limits.seconds);
    } else if (WIFSIGNALED(status)) {
        result.failure = fmt::format("crashed: {}", strsignal(WTERMSIG(status)));
    } else if (text.empty()) {
        result.failure = "ended without a word";
    } else if (text[0] == '+') {
        result.output = text.substr(1);
    } else {
        result.failure = text.substr(1);
    }
    return result;
}

}  // namespace automorph::bench
