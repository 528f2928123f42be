// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/futex.hpp"
#include "shm/mapping.hpp"

#include <memory>

namespace tandem::shm {

/// One bell per side, however many ports: 64 ready bits and one futex word. Whoever has published data rings
/// a bit at the other side's bell, after the data; that makes a system call only if the owner has said that
/// it sleeps.
class Doorbell {
  public:
    static constexpr unsigned user_bits = 62;     ///< 0..61 are the user's
    static constexpr unsigned attention_bit = 62; ///< peer joined, published or left: look at Segment
    static constexpr unsigned interrupt_bit = 63; ///< interrupt() was called

    Doorbell(std::shared_ptr<const Mapping> mapping, Side owner);

    /// [any-thread] Sets one bit, or many by one store, and wakes the owner if it sleeps.
    void ring(unsigned bit) { ring_all(std::uint64_t{1} << (bit & 63U)); }
    void ring_all(std::uint64_t bits);

    /// [one thread] Takes the bits rung so far; waits for the first at most `bound`. 0: none came.
    std::uint64_t wait(std::chrono::nanoseconds bound, const WaitOptions& how = {});
    std::uint64_t poll();

    /// [any-thread] Ends the owner's wait, now or the next, with interrupt_bit.
    void interrupt() { ring(interrupt_bit); }

    /// System calls this object has made to wake a sleeper.
    std::uint64_t wakes() const { return wakes_.load(std::memory_order_relaxed); }

  private:
    std::shared_ptr<const Mapping> mapping_;
    layout::DoorbellWords& words_;
    std::atomic<std::uint64_t> wakes_{0};
};

} // namespace tandem::shm
