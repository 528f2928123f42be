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

/// Compares what a system answers with what it has answered when it was recorded: of each topic the first with the first,
/// the second with the second, and so on. [any-thread]
class Comparison {
  public:
    /// `times`: the stamps count, too.
    explicit Comparison(bool times) : times_(times) {}

    /// The tick of a lock-step in which expect() happens from now on.
    void set_tick(std::uint64_t tick);
    /// Something that was recorded. The channel must outlive this object.
    void expect(const RecordedChannel& channel, std::uint64_t stamp, std::span<const std::byte> bytes);
    /// What has come now, on the topic of that channel. `failure`: a call has ended otherwise, in that way.
    void receive(const std::string& topic, std::uint64_t stamp, std::span<const std::byte> bytes);
    /// A difference that is none between two messages: in the tick of set_tick().
    void differ(const std::string& topic, const std::string& what);

    /// Whether everything that was expected has come.
    bool is_complete() const;
    /// No more comes: what is left over is different. `complete`: each message must have come.
    void finish(bool complete);

    std::uint64_t same() const { return same_; }
    std::uint64_t different() const { return different_; }
    /// One line: where, which member, what was recorded, what came.
    const std::string& first_difference() const { return first_; }
    /// What is left over without being a difference, a line for each topic.
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
