// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/newest_value.hpp"
#include "apps/tandem/monitor/round.hpp"
#include "apps/tandem/monitor/state.hpp"
#include "apps/tandem/observe/link_follower.hpp"

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tandem::monitor {

/// Reads one link repeatedly, without affecting its hosts. Keeps the last seconds for rates. [one thread]
class LinkReader {
  public:
    /// Throws shm::Error for an invalid link name.
    explicit LinkReader(const std::string& link) : follower_(link, {}) {}

    /// `now_ns`: time of the observation (CLOCK_MONOTONIC). `round`: bounds the reading of messages.
    LinkState read(shm::Observation observation, std::uint64_t now_ns, Round& round);
    /// Returns whether the last read() left messages unread or undecoded.
    bool was_cut() const { return cut_; }

  private:
    using Key = std::pair<shm::Side, std::string>; ///< owner and name of a ring in the segment

    struct Sample {
        std::uint64_t time_ns;
        shm::Observation seen;
    };
    // NOLINTNEXTLINE(bugprone-exception-escape): moving a nlohmann::json throws nothing
    struct Message {
        NewestValue value;
        std::uint64_t sent = 0, changed_ns = 0; ///< changed_ns 0: unchanged since the first read
    };

    void keep(shm::Observation observation, std::uint64_t now_ns);
    void change_segment(const shm::ObservedSegment& to);
    void read_sides(LinkState& link);
    void read_messages(Round& round);
    void read_rings(LinkState& link, const Round& round);
    void read_call_queues(LinkState& link, const Round& round);
    PortState read_port(const shm::ObservedRing& ring, const Round& round);
    void add_value(const shm::ObservedRing& ring, PortState& port, const Round& round);
    const Sample& newest() const { return samples_.back(); }
    const Sample& rate_sample() const;
    double per_second(const Sample& from, std::uint64_t before, std::uint64_t now) const;

    command::LinkFollower follower_;
    std::deque<Sample> samples_; ///< of one segment, oldest first
    std::map<Key, Message> messages_;
    std::map<Key, const command::FollowedPort*> ports_; ///< of the follower
    bool cut_ = false;
    std::vector<SharedPort> shared_ports_;
    std::string damage_;     ///< of the newest observation, see LinkState::damage
    command::Models models_; ///< in the newest observation
    SideState last_sides_[2];
    std::shared_ptr<const shm::ReadOnlySnapshot> file_; ///< says how the sides of the segment have ended
};

} // namespace tandem::monitor
