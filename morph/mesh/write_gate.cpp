#include "morph/mesh/write_gate.h"

#include <atomic>
#include <chrono>
#include <thread>

namespace automorph {
namespace {

constexpr int kEnding = -1;
std::atomic<int> writers{0};  // files being written, or kEnding
std::atomic<void (*)()> at_end{nullptr};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<void (*)()>::is_always_lock_free,
              "a signal handler uses them");

void end_if_free(void (*end)()) {
    int none = 0;
    if (writers.compare_exchange_strong(none, kEnding)) end();
}

}  // namespace

UnbrokenWrite::UnbrokenWrite() {
    int count = writers;
    while (true) {
        if (count == kEnding) {
            // The process ends within moments.
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            count = writers;
        } else if (writers.compare_exchange_weak(count, count + 1)) {
            return;
        }
    }
}

UnbrokenWrite::~UnbrokenWrite() {
    if (writers.fetch_sub(1) > 1) return;
    if (void (*end)() = at_end) end_if_free(end);
}

void end_when_files_are_whole(void (*end)()) {
    at_end = end;
    end_if_free(end);
}

}  // namespace automorph
