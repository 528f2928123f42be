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

/// Copies the messages of a link's data ports without affecting the hosts, across restarts of the hosts.
/// [one thread]
class LinkFollower {
  public:
    /// A port and the follower of its ring.
    struct Port : FollowedPort {
        std::string link;
        std::uint64_t generation = 0;
        shm::RingFollower ring;
        Port(FollowedPort port, std::string link_name, std::uint64_t of_generation,
             shm::RingFollower follower)
            : FollowedPort(std::move(port)), link(std::move(link_name)), generation(of_generation),
              ring(std::move(follower)) {}
    };
    /// The rings to check: all, or without those that poll() may skip for a while, see RingFollower::may_have_come().
    enum class Rings : bool { likely, all };
    using Deliver = std::function<void(const Port&, const shm::FollowedRecord&)>;

    /// Returns how many bytes of messages a poll() may still deliver; 0 ends it.
    using Budget = std::function<std::size_t()>;
    using DeliverCall = std::function<void(shm::Side callers, const shm::FollowedCall&)>;

    /// Follows the ports with these names, or all if `ports` is empty. The link need not exist yet. Throws
    /// shm::Error for an invalid link name.
    LinkFollower(std::string link, std::vector<std::string> port_names);

    /// Finds the segment, new ports and the next generation; calls `changed` if the ports or models have changed.
    /// Then delivers messages sent since the last call, of each port a bounded number of bytes. Returns whether there may be
    /// more: a writer that is faster than this thread may keep it so. With `budget`, the next call begins with the port at which
    /// the budget ended.
    bool poll(const Deliver& deliver, const std::function<void()>& changed = {}, Rings rings = Rings::likely,
              const Budget& budget = {});

    /// Delivers service calls that ended since the last call, see CallFollower::poll(). Call this after
    /// poll(), which finds the queues.
    void poll_calls(const DeliverCall& deliver, shm::CallActivity activity);

    /// Makes the follower also deliver messages of the first generation that its readers have not read yet. It always
    /// does so in later generations, and if there was no segment at first.
    void begin_with_oldest() { begin_ = shm::RingFollower::Begin::oldest; }

    const std::string& link() const { return link_; }
    /// Returns the ports of the current generation. After its end they remain until there is a new one.
    const std::vector<Port>& ports() const { return ports_; }
    /// Returns the component models of the current generation's sides.
    const Models& models() const { return models_; }
    /// Returns the number of messages overwritten before they were copied, in all generations.
    std::uint64_t lost() const;
    /// Returns the number of calls whose slots were reused before they were copied, in all generations.
    std::uint64_t lost_calls() const;
    std::uint64_t generation() const { return generation_; } ///< current generation; 0: none yet
    /// Returns whether there is a segment to follow.
    bool is_open() const { return file_ != nullptr; }

  private:
    /// Words of a segment that change when ports are added or the segment is replaced.
    struct Version {
        std::uint64_t superseded_by = 0;
        std::uint32_t published[2] = {};
        bool removed = false;
        bool operator==(const Version&) const = default;
    };

    bool look_for_ports();
    bool open(const shm::Observation& observation);
    bool poll_port(Port& port, const Deliver& deliver, const Budget& budget) const;
    Version read_version() const;
    bool wants(const std::string& port) const;

    std::string link_;
    std::vector<std::string> names_;
    std::shared_ptr<const shm::ReadOnlySnapshot> file_; ///< of the generation that is followed; null: none
    std::shared_ptr<shm::CopyMemory> memory_ =
        std::make_shared<shm::CopyMemory>(); ///< of all ports' followers
    std::uint64_t generation_ = 0, created_ns_ = 0;
    Version version_;
    std::vector<Port> ports_;
    std::size_t first_port_ = 0; ///< place of the port that the next poll() begins with
    Models models_;
    std::vector<shm::CallFollower> calls_;
    shm::RingFollower::Begin begin_ = shm::RingFollower::Begin::newest;
    std::uint64_t lost_before_ = 0, lost_calls_before_ = 0; ///< in earlier generations
    std::uint64_t next_look_ns_ = 0;
};

} // namespace tandem::command
