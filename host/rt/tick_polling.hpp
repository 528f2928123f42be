// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>

namespace tandem::rt {

/// Decides how long before a tick its thread wakes up to poll and to rehearse. A time that the user has chosen always applies.
/// By default, a thread polls only while messages cross at the places that a rehearsal reaches (note_crossings()), and only
/// while all such threads of the process together use at most a tenth of a processor. All times in ns. [tick-thread]
class TickPolling {
  public:
    /// `spin` as in TickOptions. Without `rehearse`, a default tick never polls.
    TickPolling(std::optional<std::chrono::nanoseconds> spin, std::int64_t period,
                std::function<void()> rehearse);
    ~TickPolling();
    TickPolling(const TickPolling&) = delete;
    TickPolling& operator=(const TickPolling&) = delete;

    /// Checks from time to time whether messages have crossed since the last check. Call it before each sleep.
    void review(std::int64_t now);
    /// Returns how long before a tick the sleep ends.
    std::int64_t lead() const;
    /// Notes how long after the planned end of its sleep the thread has woken up.
    void note_wake_up(std::int64_t delay);
    /// Notes for how long the thread has polled.
    void note_polled(std::int64_t time) { polled_ += time; }
    bool can_rehearse() const { return rehearse_ != nullptr; }
    void rehearse() const;

  private:
    bool messages_cross(std::int64_t now);
    void take_share();
    void update_share(std::int64_t now);
    void give_share_back();

    const bool by_default_;
    const std::int64_t period_, spin_;
    const std::function<void()> rehearse_;
    std::int64_t share_ = 0;    // of a processor, in millionths; 0: this tick does not poll by default
    std::int64_t wake_up_ = 0;  // duration of the recent wake-ups
    std::int64_t polled_ = 0;   // since the last review
    std::int64_t reviewed_ = 0; // time of the last review
    std::uint64_t crossed_ = 0; // messages up to the last review
    std::int64_t used_ = 0;     // time of the last review that found new messages; 0: none has
};

} // namespace tandem::rt
