// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/inspect/observer.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace tandem::shm {

class ReadOnlySnapshot;

/// A call that has ended, as copied by a CallFollower.
struct FollowedCall {
    std::span<const std::byte> arguments, results; ///< 8-aligned; valid during the call
    std::uint64_t submitted_ns;                    ///< CLOCK_MONOTONIC, see now_ns()
    CallStatus status;
    bool answered; ///< false: the caller gave it up before; `status` is cancelled, without results
};

/// Whether anybody may be calling while a CallFollower looks.
enum class CallActivity : bool { none, possible };

/// Copies the calls of a call queue out of its slots after they have ended. Neither side notices: nothing is written, woken
/// or locked. So a slot may be used again before its call was copied; such calls count as lost. With
/// WaitOptions::keep_history of the callers, each slot stays unchanged until all others were used.
///
/// How a copy is known to be whole: while a call is open, nobody else writes its arguments. A later copy counts if the slot
/// is still unchanged at the next poll, because the next caller writes its arguments before it announces its call. [one
/// thread]
class CallFollower {
  public:
    using Deliver = std::function<void(const FollowedCall&)>;

    /// `queue`: as observe() found it in this file. Starts with the calls that are in the slots.
    CallFollower(std::shared_ptr<const ReadOnlySnapshot> file, const ObservedCallQueue& queue);

    /// Delivers the calls that have ended, in the order of their starts. Without activity, one look is enough.
    void poll(const Deliver& deliver, CallActivity activity = CallActivity::possible);

    Side callers() const { return callers_; }
    std::uint64_t delivered() const { return delivered_; }
    std::uint64_t lost() const { return lost_; } ///< ended since the first look, and not delivered
    bool damaged() const { return damaged_; }    ///< the file has ended: nothing more is delivered

  private:
    /// The state of a slot.
    struct Slot {
        std::uint64_t delivered = 0; ///< its number of calls when the last one was delivered
        std::uint64_t copied = 0;    ///< number of the call whose arguments were copied while it was open
        std::uint64_t pending = 0;   ///< number of an ended call that is copied but not confirmed
        std::vector<std::uint64_t> arguments, results;
        std::vector<std::byte> looked; ///< the slot's bytes at the last look, with pending
    };
    struct Ended;

    void look_at(std::uint32_t index, CallActivity activity, std::vector<Ended>& ended);
    bool make_room(std::vector<std::uint64_t>& memory, std::uint64_t bytes);
    bool copy(std::uint32_t index, std::span<const std::byte> in_slot, std::size_t bytes,
              std::vector<std::uint64_t>& to);

    std::shared_ptr<const ReadOnlySnapshot> file_;
    const Side callers_;
    const std::uint64_t slots_begin_, overflow_begin_, overflow_bytes_, max_bytes_;
    std::vector<Slot> slots_;
    std::vector<std::byte> bytes_; ///< of all slots, read at once
    std::uint64_t held_ = 0;       ///< bytes of all copied arguments and results
    std::uint64_t delivered_ = 0, lost_ = 0;
    bool damaged_ = false, looked_ = false;
};

} // namespace tandem::shm
