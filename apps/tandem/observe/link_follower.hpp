// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/observe/followed_port.hpp"
#include "shm/inspect/call_follower.hpp"
#include "shm/inspect/ring_follower.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tandem::command {

/// Copies the messages of a link's data ports beside their readers, over restarts of its hosts. Neither host notices.
/// [one thread]
class LinkFollower {
  public:
    /// A port, and the follower of its ring.
    struct Port : FollowedPort {
        std::string link;
        std::uint64_t generation = 0;
        shm::RingFollower ring;
        Port(FollowedPort port, std::string link_name, std::uint64_t of_generation,
             shm::RingFollower follower)
            : FollowedPort(std::move(port)), link(std::move(link_name)), generation(of_generation),
              ring(std::move(follower)) {}
    };
    using Deliver = std::function<void(const Port&, const shm::FollowedRecord&)>;

    using DeliverCall = std::function<void(shm::Side callers, const shm::FollowedCall&)>;

    /// Follows the ports of these names, or all if there are none. The link need not be there yet. Throws shm::Error for
    /// an impossible link name.
    LinkFollower(std::string link, std::vector<std::string> port_names);

    /// Looks for a segment, and for ports that have come, or for the next generation. `changed` is called when the ports
    /// are others than before. Then delivers what was sent since the last call. Returns whether there may be more.
    /// `closely`: also what can be missed for a while, see RingFollower::may_have_come().
    bool poll(const Deliver& deliver, const std::function<void()>& changed = {}, bool closely = false);

    /// The service calls that have ended since the last call, see CallFollower::poll(). After poll(), which finds the queues.
    void poll_calls(const DeliverCall& deliver, bool quiet);

    /// Of the generation that is found first also the messages that its readers have not read yet, not only those to come.
    /// So it is of every one that comes later, and if at the first look there was none.
    void begin_with_oldest() { begin_ = shm::RingFollower::Begin::oldest; }

    const std::string& link() const { return link_; }
    /// Ports of the present generation; those of one that has ended stay until there is a new one.
    const std::vector<Port>& ports() const { return ports_; }
    /// Messages that were sent and overwritten before they were copied, in all generations.
    std::uint64_t lost() const;
    /// Calls that have ended and whose slots were used again before they were copied, in all generations.
    std::uint64_t lost_calls() const;
    std::uint64_t generation() const { return generation_; } ///< that is followed; 0: none yet
    /// Whether there is a segment to follow.
    bool is_open() const { return file_ != nullptr; }

  private:
    /// Words of a segment that change when ports come or the segment is replaced.
    struct Version {
        std::uint64_t superseded_by = 0;
        std::uint32_t published[2] = {};
        bool removed = false;
        bool operator==(const Version&) const = default;
    };

    bool look_for_ports();
    bool open(const shm::Observation& observation);
    Version read_version() const;
    bool wants(const std::string& port) const;

    std::string link_;
    std::vector<std::string> names_;
    std::shared_ptr<const shm::ReadOnlySnapshot> file_; ///< of the generation that is followed; null: none
    std::uint64_t generation_ = 0, created_ns_ = 0;
    Version version_;
    std::vector<Port> ports_;
    std::vector<shm::CallFollower> calls_;
    shm::RingFollower::Begin begin_ = shm::RingFollower::Begin::newest;
    std::uint64_t lost_before_ = 0, lost_calls_before_ = 0; ///< in earlier generations
    std::uint64_t next_look_ns_ = 0;
};

} // namespace tandem::command
