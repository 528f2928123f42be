// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/channel/channel.hpp"
#include "proxy/link/protocol/port_table.hpp"

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace tandem::link {

/// The channels of one link, by port name. A channel is created when it is first asked for and lives as long
/// as the table, so the references stay valid while sessions come and go. [any-thread]
class ChannelTable {
  public:
    /// `wake_supervisor` makes the supervisor thread look at the channels now.
    explicit ChannelTable(std::function<void()> wake_supervisor)
        : wake_supervisor_(std::move(wake_supervisor)) {}

    ChannelWriter& writer(const std::string& port);
    ChannelReader& reader(const std::string& port);

    /// Binds those channels of the data ports in `ports` that are not bound to their rings in the segment. `owner` is the side
    /// whose ports they are, and which created the rings. Throws LinkError if a port has no ring, shm::Error
    /// if a ring is damaged; channels that were bound before stay bound until unbind_all().
    void bind(const std::shared_ptr<shm::Segment>& segment, const PortTable& ports, shm::Side owner);
    /// Returns how many messages were under way, which nobody will read.
    std::uint64_t unbind_all();

    /// Rings the peer's doorbell from now on for messages of the ports in the list, and of no others.
    void set_listened_ports(const std::vector<std::string>& ports);

    /// Logs each port whose sender has been silent for longer than its deadline, once for each silence, and appends its name
    /// to `missed`. Returns how soon to call it again; longest_wait if no port has a deadline. [supervisor-thread]
    std::chrono::nanoseconds check_deadlines(std::vector<std::string>& missed);

    /// True if a bound ring holds words that its protocol cannot produce: a process outside of the link has
    /// written there, and nothing more would pass through that ring.
    bool has_corrupt_ring() const;

  private:
    const std::function<void()> wake_supervisor_;
    mutable std::mutex mutex_; ///< the maps; each channel has its own lock
    std::map<std::string, ChannelWriter> writers_;
    std::map<std::string, ChannelReader> readers_;
};

} // namespace tandem::link
