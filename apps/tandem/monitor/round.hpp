// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/os/clock.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace tandem::monitor {

struct RoundBounds {
    std::size_t message_bytes = std::size_t{256} << 20;
    std::uint64_t time_ns = 1'000'000'000;
};

/// Limits one round of reading, because other processes determine the amount of data. [one thread]
class Round {
  public:
    /// Begins the round. `stop`: also ends it; null: nothing does.
    explicit Round(const std::atomic<bool>* stop = nullptr, const RoundBounds& bounds = {})
        : stop_(stop), end_ns_(shm::now_ns() + bounds.time_ns), bytes_left_(bounds.message_bytes) {}

    bool is_stopped() const { return stop_ != nullptr && *stop_; }
    /// Returns true after the stop, or when the time is over.
    bool is_over() const { return is_stopped() || shm::now_ns() >= end_ns_; }
    /// Counts a copied message.
    void count_message(std::size_t bytes) {
        constexpr std::size_t per_message = 64; // also messages without content take time
        bytes_left_ -= bytes_left_ < bytes + per_message ? bytes_left_ : bytes + per_message;
    }
    /// Returns how many bytes of messages may still be copied; 0 if the round is over.
    std::size_t bytes_left() const { return is_over() ? 0 : bytes_left_; }

  private:
    const std::atomic<bool>* stop_;
    std::uint64_t end_ns_;
    std::size_t bytes_left_;
};

} // namespace tandem::monitor
