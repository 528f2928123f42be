// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/process/log_throttle.hpp"
#include "proxy/link/call_workers.hpp"
#include "proxy/link/channel/arrival_notifier.hpp"
#include "proxy/link/channel/channel_table.hpp"
#include "proxy/link/peer_supervisor.hpp"
#include "proxy/link/protocol/control.hpp"
#include "proxy/link/protocol/link_error.hpp"
#include "proxy/link/session/link_options.hpp"
#include "proxy/link/session/link_state.hpp"
#include "proxy/link/task_queue.hpp"

#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace tandem::link {

/// One side of a link: shares its port table with the peer, moves data and calls, and survives the death of the peer.
/// The death unbinds all channels. A new peer with matching ports binds them again. This class is only the interface;
/// each of its members does one of these things in its own threads.
class Link {
  public:
    /// `own_ports` is the table to share; it may be empty. The handler must outlive the link.
    Link(shm::Side side, LinkOptions options, PortTable own_ports, LinkHandler& handler);
    ~Link();

    /// Joins the segment and starts the link's threads. Throws shm::Error if the segment cannot be joined. Also
    /// installs shm's SIGBUS handler: from here on, a process that truncates the segment's file ends the session, not
    /// this process.
    void open();
    /// Waits for the peer. Throws LinkError, one line, if the peer does not come within `timeout`, if `gives_up`,
    /// which is called repeatedly, returns true, or if the peer's ports were refused. Messages call the peer
    /// `peer_name`.
    void wait_until_up(
        std::chrono::milliseconds timeout, const std::string& peer_name,
        const std::function<bool()>& gives_up = [] { return false; });
    /// Ends all threads and leaves the segment. Waits for running tasks and calls. Afterwards the handler is not
    /// called any more. [not in a handler's function, see in_link_thread()]
    void close();

    /// Replaces the table that this side shares, in this session and in later ones. Ports in both the old and the new
    /// table keep their channels and messages. [any-thread]
    void set_ports(PortTable own_ports) { supervisor_.set_ports(std::move(own_ports)); }

    bool is_up() const { return state_.is_up(); }
    /// Returns how often the link has come up, which identifies the connection. [any-thread]
    std::uint64_t connections() const { return state_.connections(); }

    /// Calls the peer's handler and waits at most `timeout` for its reply. Failures are also replies. [any-thread but
    /// the supervisor's]
    Reply call(const Request&, std::chrono::milliseconds timeout);
    /// Calls with an encoded request. The reply is in `memory`. Allocates no memory once `memory` is large enough.
    ReplyView call(std::span<const std::byte> encoded_request, std::chrono::milliseconds timeout,
                   wire::MessageBuffer& memory);

    /// Calls the peer's handler in a thread of the link, one call at a time, in order. For operations without a reply. Returns
    /// ok at once, or when fewer than max_waiting_sends such calls wait; the call will then be made if the peer is connected,
    /// and failures are logged. Returns overload if that takes longer than `timeout`. [any-thread]
    Reply send(const Request&, std::chrono::milliseconds timeout);

    /// Executes `task` in the task thread, after the previously posted tasks. Drops it if the link is closing.
    /// [any-thread]
    void post(std::function<void()> task) { tasks_.post(std::move(task)); }

    /// Returns the channel of a data port of either table. The channel is created on first use and bound while the
    /// link is up. A port that gets another type gets another channel; the name alone selects the channel of the
    /// first type. The reference is valid as long as the link.
    ChannelWriter& writer(const Port& port) { return channels_.writer(port); }
    ChannelReader& reader(const Port& port) { return channels_.reader(port); }
    ChannelWriter& writer(const std::string& port) { return channels_.writer(port); }
    ChannelReader& reader(const std::string& port) { return channels_.reader(port); }

    /// Executes control::listen: see ChannelTable. Throws LinkError if the arguments are damaged.
    void serve_listen(std::span<const std::byte> arguments) {
        channels_.set_listened_ports(control::decode_port_names(arguments));
    }

    /// Calls `listener` in the notifier thread after messages have arrived in a channel of this link; see
    /// ArrivalNotifier. The call may be up to a second late until request_rings() has succeeded for the port.
    void set_arrival_listener(const ChannelReader& channel, std::function<void()> listener,
                              const void* consumer = nullptr) {
        arrivals_.set_listener(channel, std::move(listener), consumer);
    }
    /// Lets a consumer wait in its own thread: see ArrivalNotifier.
    ArrivalNotifier::Wait wait_for_arrivals(const void* consumer) { return arrivals_.wait_as(consumer); }
    void wake_consumer(const void* consumer) { arrivals_.wake(consumer); }
    /// Asks the peer to ring the doorbell after each message of `ports`, which are all ports with listeners. After a
    /// failure, the notifier checks for messages once a second. [task-thread]
    Reply request_rings(const std::vector<std::string>& ports, std::chrono::milliseconds timeout);

  private:
    const LinkOptions options_;
    LinkState state_;
    ChannelTable channels_;
    TaskQueue tasks_;
    TaskQueue sends_; ///< started by the first call without a reply
    process::LogThrottle failed_sends_;
    PeerSupervisor supervisor_;
    CallWorkers workers_;
    ArrivalNotifier arrivals_;
};

} // namespace tandem::link
