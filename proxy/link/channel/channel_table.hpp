// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/channel/channel.hpp"
#include "proxy/link/protocol/port_table.hpp"
#include "proxy/link/protocol/port_types.hpp"

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace tandem::link {

/// The channels of one link, by port name and type. A channel is created on first use and lives as long as the table,
/// so references stay valid across sessions. [any-thread]
class ChannelTable {
  public:
    /// `wake_supervisor` makes the supervisor thread check the channels now.
    explicit ChannelTable(std::function<void()> wake_supervisor)
        : wake_supervisor_([this, wake = std::move(wake_supervisor)] {
              channel_has_called_ = true;
              wake();
          }) {}
    ChannelTable(const ChannelTable&) = delete;
    ChannelTable& operator=(const ChannelTable&) = delete;

    ChannelWriter& writer(const Port& port);
    ChannelReader& reader(const Port& port);
    /// Return the channel of the first type that a port of this name has or had.
    ChannelWriter& writer(const std::string& port);
    ChannelReader& reader(const std::string& port);

    /// Binds the unbound channels of the data ports in `ports` to their rings in the segment. `owner` is the side
    /// with these ports, which created the rings. Throws LinkError if a port has no ring, shm::Error if a ring is
    /// damaged. Channels that are already bound stay bound until unbind_all().
    void bind(const std::shared_ptr<shm::Segment>& segment, const PortTable& ports, shm::Side owner);
    /// Unbinds all channels. Returns the number of messages that are lost.
    std::uint64_t unbind_all();

    /// Rings the peer's doorbell from now on for messages of these ports and of no others. Includes ports that are
    /// bound later. Ends with unbind_all().
    void set_listened_ports(const std::vector<std::string>& ports);

    /// Logs each port whose sender has been silent for longer than its deadline, once per silence, and appends its
    /// name to `missed`. Returns how soon to call it again; longest_wait if no port has a deadline.
    /// [supervisor-thread]
    std::chrono::nanoseconds check_deadlines(std::vector<std::string>& missed);

    /// Returns true, once, if a bound ring contains words that its protocol cannot produce. In that case, a process
    /// outside the link has written to the ring, and nothing more would pass through it. [supervisor-thread]
    bool has_corrupt_ring();

  private:
    using Key = std::pair<std::string, std::uint32_t>; ///< a port's name and the number of its type
    ChannelWriter& writer_of(const Key& key);
    ChannelReader& reader_of(const Key& key);

    std::atomic<bool> channel_has_called_{false}; ///< a channel is damaged or has got a deadline
    const std::function<void()> wake_supervisor_;
    mutable std::mutex mutex_; ///< guards the members below; each channel has its own lock
    PortTypes types_;
    std::map<Key, ChannelWriter> writers_;
    std::map<Key, ChannelReader> readers_;
    std::set<std::string> listened_ports_; ///< their messages wake the peer
};

} // namespace tandem::link
