// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/replay/recording.hpp"

#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace tandem::command {

/// Compares a system's answers with the recorded ones, per topic and in order. [any-thread]
class Comparison {
  public:
    /// `times`: also compare the time stamps.
    explicit Comparison(bool times) : times_(times) {}

    /// Sets the lock-step tick of subsequent calls of expect().
    void set_tick(std::uint64_t tick);
    /// Adds a recorded message. The channel must outlive this object.
    void expect(const RecordedChannel& channel, std::uint64_t stamp, std::span<const std::byte> bytes);
    /// Adds a message that arrived now on the channel's topic.
    void receive(const std::string& topic, std::uint64_t stamp, std::span<const std::byte> bytes);
    /// Adds a difference other than between two messages, in the tick of set_tick().
    void differ(const std::string& topic, const std::string& what);

    /// Returns whether all expected messages have arrived.
    bool is_complete() const;
    /// Returns whether an expected message has not arrived, of a topic that stop_waiting() has not returned.
    bool is_waiting() const;
    /// Returns the topics for which is_waiting() returned true. They are waited for again once all their expected
    /// messages have arrived.
    std::vector<std::string> stop_waiting();
    /// Ends the comparison. Unmatched messages are differences. `complete`: each expected message must have
    /// arrived.
    void finish(bool complete);

    std::uint64_t same() const { return same_; }
    std::uint64_t different() const { return different_; }
    /// Returns one line: place, member, recorded value, received value.
    const std::string& first_difference() const { return first_; }
    /// Returns unmatched messages that are not differences, one line per topic.
    const std::vector<std::string>& notes() const { return notes_; }

  private:
    struct Item {
        std::vector<std::byte> bytes;
        std::uint64_t stamp = 0;
        std::optional<std::uint64_t> tick;
    };
    struct Topic {
        const RecordedChannel* channel = nullptr;
        std::deque<Item> expected, received;
        std::uint64_t compared = 0;
        bool is_late = false; ///< was waited for in vain, and has not caught up
        bool is_waited_for() const { return !expected.empty() && !is_late; }
    };
    void compare(const std::string& name, Topic& topic);
    void note_difference(const std::string& topic, const std::string& where, const std::string& what);
    std::string describe(const Topic& topic, const Item& expected, const Item& received) const;

    const bool times_;
    mutable std::mutex mutex_;
    std::map<std::string, Topic> topics_;
    std::optional<std::uint64_t> tick_;
    std::uint64_t same_ = 0, different_ = 0;
    std::string first_;
    std::vector<std::string> notes_;
};

} // namespace tandem::command
