#include "morph/mesh/write_gate.h"

#include <array>
#include <atomic>
#include <cassert>
#include <chrono>
#include <thread>

namespace automorph {
namespace {

constexpr int kEnding = -1;
std::atomic<int> writers{0};  // files being written, or kEnding
std::atomic<void (*)()> at_end{nullptr};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<void (*)()>::is_always_lock_free,
              "a signal handler uses them");

/// Changed by writers only, so that nobody does at the end.
struct Undoing {
    std::atomic<void (*)(void*)> undo{nullptr};
    void* what = nullptr;
};
std::array<Undoing, 8> undoings;

void end_if_free(void (*end)()) {
    int none = 0;
    if (!writers.compare_exchange_strong(none, kEnding)) return;
    for (const Undoing& each : undoings) {
        if (void (*undo)(void*) = each.undo) undo(each.what);
    }
    end();
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

UndoneAtEnd::UndoneAtEnd(void (*undo)(void*), void* what) {
    const UnbrokenWrite gate;
    for (std::size_t i = 0; i < undoings.size() && slot_ < 0; ++i) {
        void (*none)(void*) = nullptr;
        if (!undoings[i].undo.compare_exchange_strong(none, undo)) continue;
        undoings[i].what = what;
        slot_ = static_cast<int>(i);
    }
    assert(slot_ >= 0);
}

UndoneAtEnd::~UndoneAtEnd() {
    const UnbrokenWrite gate;
    if (slot_ >= 0) undoings[static_cast<std::size_t>(slot_)].undo = nullptr;
}

void end_when_files_are_whole(void (*end)()) {
    at_end = end;
    end_if_free(end);
}

}  // namespace automorph
