// Replaces the allocation functions of the test program, so that tests can bound memory.
#include "tests/morph/mesh/allocation_meter.h"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> alive{0}, highest{0};

void* counted(void* memory) {
    if (memory == nullptr) return memory;
    const std::size_t now = alive += malloc_usable_size(memory);
    std::size_t seen = highest;
    while (now > seen && !highest.compare_exchange_weak(seen, now)) {
    }
    return memory;
}

void discount(void* memory) {
    if (memory != nullptr) alive -= malloc_usable_size(memory);
    std::free(memory);
}

}  // namespace

void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return counted(std::malloc(size));
}
void* operator new(std::size_t size) {
    void* const memory = counted(std::malloc(size));
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}
void* operator new[](std::size_t size) {
    return operator new(size);
}
void* operator new[](std::size_t size, const std::nothrow_t& none) noexcept {
    return operator new(size, none);
}
void operator delete(void* memory) noexcept {
    discount(memory);
}
void operator delete[](void* memory) noexcept {
    discount(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    discount(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
    discount(memory);
}

namespace automorph::testing {

AllocationMeter::AllocationMeter() : before_(alive) {
    highest = before_;
}

std::size_t AllocationMeter::peak() const {
    return highest - before_;
}

}  // namespace automorph::testing
