#include "render/program/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <initializer_list>

#include "morph/mesh/write_gate.h"

namespace automorph::program {
namespace {

// A signal handler may only take atomics and call the system.
std::atomic<int> received{0};
std::atomic<const char*> advice{""};

void print(const char* text) {
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text, std::strlen(text));
}

void end() {
    if (::isatty(STDERR_FILENO) != 0) print("\r\x1b[K");  // a progress bar may stand there
    print("automorph: stopped");
    print(advice);
    print("\n");
    ::_exit(128 + received);
}

void receive(int signal) {
    const int error = errno;
    int none = 0;
    if (!received.compare_exchange_strong(none, signal)) ::_exit(128 + signal);
    end_when_files_are_whole(end);
    errno = error;
}

}  // namespace

void end_on_signals() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction action {};
        if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
        action.sa_handler = receive;
        action.sa_flags = SA_RESTART;
        ::sigemptyset(&action.sa_mask);
        ::sigaction(signal, &action, nullptr);
    }
}

void set_stop_advice(const char* text) {
    advice = text;
}

}  // namespace automorph::program
