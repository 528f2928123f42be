// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/replay/answers.hpp"
#include "apps/tandem/replay/comparison.hpp"
#include "apps/tandem/replay/recording.hpp"
#include "proxy/link/link.hpp"

#include <atomic>
#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace tandem::command {

/// One side of a link, in place of the recorded host: shares the recorded ports, sends messages on request,
/// answers calls as recorded, and accepts the other proxy's commands. The peer treats it like any other host,
/// even when it ends. [one thread, except where noted]
class ReplayPeer final : private link::LinkHandler {
  public:
    /// `name`: current name of the link. `check` may be null. All references must outlive this object.
    ReplayPeer(const RecordedLink& recorded, const std::string& name, shm::Side side, Answers& answers,
               Comparison* check);
    ~ReplayPeer() override { close(); }

    /// Joins the link; the peer may join later. Throws shm::Error with one line, for example if another
    /// process has this side.
    void open();
    /// Waits until the peer has joined, its ports have the recorded types, and the components of both sides
    /// are active. Throws std::runtime_error with one line.
    void wait_until_active(std::chrono::milliseconds timeout, const std::function<bool()>& gives_up);
    /// Deactivates an RTC that it activated, and leaves the link.
    void close();

    /// Sends a message. Returns false if there is no peer or its queue refused the message.
    bool send(const RecordedEvent& message);
    /// Makes the recorded call and returns the reply.
    link::Reply call(const RecordedEvent& request);
    /// Receives messages of the peer since the last call. Returns whether there were any.
    bool poll();
    /// Returns whether the peer has read all messages, by reading the segment from outside.
    bool all_taken() const;
    bool is_up() const { return link_.is_up(); }

    const std::string& recorded_name() const { return recorded_.name; }
    shm::Side side() const { return side_; }

  private:
    // In the link's threads.
    std::string check_peer_ports(link::PortTable& peer) override;
    void link_state_changed(bool) override {}
    void deadline_missed(const std::string&) override {}
    void peer_connected() override;
    void peer_disconnected() override { active_ = false; }
    link::Reply serve(const link::Request& request) override;

    link::Reply execute_command(const link::Request& request);
    std::string activate_peer();
    std::string topic_of(const std::string& port) const { return "/" + recorded_.name + "/" + port; }

    const RecordedLink& recorded_;
    const std::string name_;
    const shm::Side side_;
    Answers& answers_;
    Comparison* const check_;
    std::vector<std::string> received_ports_; ///< ports whose messages come to this side
    std::atomic<bool> active_{false};
    std::mutex failure_mutex_;
    std::string failure_; ///< of the peer's activation
    link::Link link_;     ///< last: its threads use everything above
};

} // namespace tandem::command
