// SPDX-License-Identifier: Apache-2.0
// Internal to CallClient: the callers that have found no slot.
#pragma once
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <list>
#include <mutex>

namespace tandem::shm {

/// The callers of this process that wait for a slot, in the order in which they came. [any-thread]
class SlotTurns {
  public:
    /// The place of one caller, from its construction to its destruction.
    class Turn {
      public:
        explicit Turn(SlotTurns& turns);
        ~Turn();
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;

        /// Waits, at most `bound`, until a slot may be free for this caller. Returns whether it is this caller's turn.
        bool wait(std::chrono::nanoseconds bound);
        /// Returns whether it is this caller's turn.
        bool has_come() const;

      private:
        friend class SlotTurns;
        SlotTurns& turns_;
        std::list<Turn*>::iterator place_;
        std::condition_variable woken_;
    };

    /// Returns whether a caller waits. One load.
    bool any() const { return count_.load(std::memory_order_relaxed) != 0; }
    /// Tells the first caller that a slot is free.
    void wake_first();

  private:
    mutable std::mutex mutex_; ///< guards waiting_
    std::list<Turn*> waiting_;
    std::atomic<std::uint32_t> count_{0}; ///< the size of waiting_
};

} // namespace tandem::shm
