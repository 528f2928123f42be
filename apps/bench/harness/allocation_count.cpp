// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/harness/allocation_count.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
// A plain counter. Allocations of all threads are counted; their order does not matter.
std::atomic<std::uint64_t> count{0};
} // namespace

namespace tandem::bench {
std::uint64_t allocation_count() { return count.load(std::memory_order_relaxed); }
} // namespace tandem::bench

// The array, nothrow and sized forms of the standard library call these two. Aligned allocations are not counted.
void* operator new(std::size_t bytes) {
    count.fetch_add(1, std::memory_order_relaxed);
    if (void* memory = std::malloc(bytes == 0 ? 1 : bytes)) return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
