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

/// One side of a link: shares its port table with the peer, moves data and calls, and survives the death of
/// the peer. What was bound is unbound then, and bound again when a peer with fitting ports has come. This
/// class is only the surface; each of its members does one of these things, in threads of its own.
class Link {
  public:
    /// `own_ports` is the table to share, may be empty. The handler must outlive the link.
    Link(shm::Side side, LinkOptions options, PortTable own_ports, LinkHandler& handler);
    ~Link();

    /// Joins the segment and starts the link's threads. Throws shm::Error when the segment cannot be joined.
    /// From here on a process that truncates the segment's file ends the session, not this process: this is
    /// the one place that installs shm's handler of SIGBUS.
    void open();
    /// Waits for the peer. Throws LinkError, one line, if it does not come within `timeout` or before `gives_up`, which is
    /// asked now and then, or if its ports were refused. `peer_name` is what the message calls it.
    void wait_until_up(
        std::chrono::milliseconds timeout, const std::string& peer_name,
        const std::function<bool()>& gives_up = [] { return false; });
    /// Ends all threads and leaves the segment; waits for tasks and calls that are being executed. Afterwards
    /// nothing calls the handler any more. [not in a handler's function]
    void close();

    /// Replaces the table that this side shares, in this session and in later ones. Ports that were in it before and still are
    /// keep their channels and the messages in them. [any-thread]
    void set_ports(PortTable own_ports) { supervisor_.set_ports(std::move(own_ports)); }

    bool is_up() const { return state_.is_up(); }
    /// How often the link has come up: another number is another connection. [any-thread]
    std::uint64_t connections() const { return state_.connections(); }

    /// Calls the peer's handler and waits for its reply, never longer than `timeout`. Failures are replies,
    /// too. [any-thread but the supervisor's]
    Reply call(const Request&, std::chrono::milliseconds timeout);
    /// The same with a request that is encoded already; the reply is in `memory`. No allocation once there is memory.
    ReplyView call(std::span<const std::byte> encoded_request, std::chrono::milliseconds timeout,
                   wire::MessageBuffer& memory);

    /// Calls the peer's handler in a thread of the link's and returns at once, for operations without a reply. The
    /// calls are made one after the other, in order. ok: it will be called, if the peer is there then; failures are
    /// logged. overload: 256 such calls wait already. [any-thread]
    Reply send(const Request&, std::chrono::milliseconds timeout);

    /// Executes `task` in the task thread, after those posted before; not at all once the link is closing.
    /// [any-thread]
    void post(std::function<void()> task) { tasks_.post(std::move(task)); }

    /// The channel of a data port of either table: created on first use, bound while the link is up. A port that gets
    /// another type gets another channel; by its name alone it has that of its first type. The reference is valid as long
    /// as the link.
    ChannelWriter& writer(const Port& port) { return channels_.writer(port); }
    ChannelReader& reader(const Port& port) { return channels_.reader(port); }
    ChannelWriter& writer(const std::string& port) { return channels_.writer(port); }
    ChannelReader& reader(const std::string& port) { return channels_.reader(port); }

    /// Executes control::listen: see ChannelTable. Throws LinkError when the arguments are damaged.
    void serve_listen(std::span<const std::byte> arguments) {
        channels_.set_listened_ports(control::decode_port_names(arguments));
    }

    /// Calls `listener` in the notifier thread after messages of the channel, of this link, have arrived; see
    /// ArrivalNotifier. Up to a second late until request_rings() has succeeded for its port.
    void set_arrival_listener(const ChannelReader& channel, std::function<void()> listener,
                              const void* consumer = nullptr) {
        arrivals_.set_listener(channel, std::move(listener), consumer);
    }
    /// A consumer may wait in its own thread: see ArrivalNotifier.
    ArrivalNotifier::Wait wait_for_arrivals(const void* consumer) { return arrivals_.wait_as(consumer); }
    void wake_consumer(const void* consumer) { arrivals_.wake(consumer); }
    /// Asks the peer to ring the doorbell after each message of these ports, of all that have listeners. After a failure
    /// arrivals are looked for once a second. [task-thread]
    Reply request_rings(const std::vector<std::string>& ports, std::chrono::milliseconds timeout);

  private:
    const LinkOptions options_;
    LinkState state_;
    ChannelTable channels_;
    TaskQueue tasks_;
    TaskQueue sends_; ///< started with the first call without a reply
    process::LogThrottle failed_sends_;
    PeerSupervisor supervisor_;
    CallWorkers workers_;
    ArrivalNotifier arrivals_;
};

} // namespace tandem::link
