// SPDX-License-Identifier: Apache-2.0
// Publishes the tick counters of this process. Other processes of the same user can read them without asking this
// process: they are in a memory file without a path (memfd_create), found as /proc/PID/fd/N. The file ends with the
// process. Native byte order.
#pragma once

#include "host/crash/callback_scope.hpp"
#include "host/process/published/notices.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace tandem::rt {

/// One periodic tick. The thread that ticks writes it with relaxed atomic operations.
struct alignas(64) TickSlot {
    static constexpr std::size_t octaves = 32; ///< classes of times: below 64 ns, below 128 ns, ...
    std::uint64_t period_ns;                   ///< 0: the slot is free; written last when the slot is taken
    std::uint64_t ticks, overruns, skipped;
    std::int64_t lateness_ns_last, lateness_ns_max, execution_ns_max;
    /// The time on CLOCK_MONOTONIC at which the next tick is due. If it is in the distant past, the thread hangs in a callback
    /// or gets no processor. 0: no tick is due, as before the first tick, while no component is active, and in lock-step.
    std::int64_t due_ns;
    // A tick that no other process can see writes only the members above, which are in one cache line.
    char name[80]; ///< the owner of the ticks; NUL-terminated
    std::uint64_t lateness[octaves];
    crash::CallbackText callback;     ///< the callback that the thread is in
    std::uint64_t execution[octaves]; ///< durations of the cycles
};

struct TickPage {
    static constexpr char magic_text[8] = {'T', 'A', 'N', 'D', 'T', 'I', 'C', '4'};
    static constexpr const char* file_name = "tandem-ticks";
    static constexpr std::size_t slots = 64;
    char magic[8];
    TickSlot slot[slots];
};

/// Owns a slot of this process's page and releases it on destruction. If there is no page or no free slot, owns a
/// private slot that no other process can see, and says so in a notice (host/process/published/notices.hpp). [construction and destruction: any-thread]
class OwnTickSlot {
  public:
    OwnTickSlot(const std::string& name, std::uint64_t period_ns);
    ~OwnTickSlot();
    OwnTickSlot(const OwnTickSlot&) = delete;
    OwnTickSlot& operator=(const OwnTickSlot&) = delete;
    TickSlot* operator->() const { return slot_; }
    /// Returns whether other processes see the slot.
    bool is_public() const { return private_ == nullptr; }

  private:
    TickSlot* slot_ = nullptr;
    std::unique_ptr<TickSlot> private_;
    std::optional<process::OwnNotice> unseen_;
};

/// Returns the index of the class that a lateness or a duration falls into.
constexpr std::size_t time_octave(std::int64_t ns) {
    constexpr unsigned first_bits = 6;
    const auto bits =
        static_cast<std::size_t>(std::bit_width(static_cast<std::uint64_t>(std::max<std::int64_t>(ns, 1))));
    return std::clamp<std::size_t>(bits, first_bits, first_bits + TickSlot::octaves - 1) - first_bits;
}

/// Adds to a counter that only this thread writes.
inline void count(std::uint64_t& counter, std::uint64_t more = 1) {
    const std::atomic_ref<std::uint64_t> atomic(counter);
    atomic.store(atomic.load(std::memory_order_relaxed) + more, std::memory_order_relaxed);
}

} // namespace tandem::rt
