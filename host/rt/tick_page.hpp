// SPDX-License-Identifier: Apache-2.0
// Counters of the ticks of this process, where other processes of the same user can read them without asking: in a memory
// file without a name (memfd_create), which they find as /proc/PID/fd/N and which ends with the process. Native byte order.
#pragma once

#include "host/crash/callback_scope.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>

namespace tandem::rt {

/// One periodic tick. Written by the thread that ticks, by relaxed atomic operations.
struct alignas(64) TickSlot {
    static constexpr std::size_t octaves = 32; ///< lateness: below 64 ns, below 128 ns, ...
    std::uint64_t period_ns;                   ///< 0: the slot is free; stored last when it is taken
    std::uint64_t ticks, overruns, skipped;
    std::int64_t lateness_ns_last, lateness_ns_max;
    char name[80]; ///< whose ticks they are; NUL-terminated
    std::uint64_t lateness[octaves];
    /// When the next tick is due, on CLOCK_MONOTONIC. Long past: the thread hangs in a callback, or gets no processor. 0: none
    /// is due, as before the first one, while no component is active, and in lock-step.
    std::int64_t due_ns;
    crash::CallbackText callback; ///< that the thread is in
};

struct TickPage {
    static constexpr char magic_text[8] = {'T', 'A', 'N', 'D', 'T', 'I', 'C', '2'};
    static constexpr const char* file_name = "tandem-ticks";
    static constexpr std::size_t slots = 64;
    char magic[8];
    TickSlot slot[slots];
};

/// A slot of this process's page, given back at the end. Without room in the page, or without a page, one that nobody else
/// sees. [construction and destruction: any-thread]
class OwnTickSlot {
  public:
    OwnTickSlot(const std::string& name, std::uint64_t period_ns);
    ~OwnTickSlot();
    OwnTickSlot(const OwnTickSlot&) = delete;
    OwnTickSlot& operator=(const OwnTickSlot&) = delete;
    TickSlot* operator->() const { return slot_; }

  private:
    TickSlot private_{};
    TickSlot* slot_;
};

/// Which of the octaves a lateness falls into.
constexpr std::size_t lateness_octave(std::int64_t ns) {
    std::size_t octave = 0;
    for (std::int64_t end = 64; ns >= end && octave + 1 < TickSlot::octaves; end *= 2) ++octave;
    return octave;
}

/// Adds to a counter that only this thread writes.
inline void count(std::uint64_t& counter, std::uint64_t more = 1) {
    const std::atomic_ref<std::uint64_t> atomic(counter);
    atomic.store(atomic.load(std::memory_order_relaxed) + more, std::memory_order_relaxed);
}

} // namespace tandem::rt
