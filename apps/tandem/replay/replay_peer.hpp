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

/// One side of a link, in the place of the host that had it when it was recorded: shares the recorded ports, sends what it is
/// told to, answers calls as they were answered, and says yes to the other proxy's commands. To the peer it is a host as any
/// other: it comes, and when it ends it is gone, and whatever must stop then stops. [one thread, but for what is said]
class ReplayPeer final : private link::LinkHandler {
  public:
    /// `name`: of the link now. `check` may be null. All references must outlive this object.
    ReplayPeer(const RecordedLink& recorded, const std::string& name, shm::Side side, Answers& answers,
               Comparison* check);
    ~ReplayPeer() override { close(); }

    /// Joins the link; the peer may come later. Throws shm::Error, one line, also if somebody has this side.
    void open();
    /// Until the peer is there, its ports have the recorded types, and its component and that behind this side are active.
    /// Throws std::runtime_error in one line.
    void wait_until_active(std::chrono::milliseconds timeout, const std::function<bool()>& gives_up);
    /// Asks an RTC that was activated to stop, and leaves.
    void close();

    /// False: there is no peer, or its queue has refused the message.
    bool send(const RecordedEvent& message);
    /// Makes the recorded call; returns the reply.
    link::Reply call(const RecordedEvent& request);
    /// Takes what the peer has sent since the last time. Returns whether there was anything.
    bool poll();
    /// Whether the peer has taken all that was sent. Looks at the segment from outside.
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
    std::vector<std::string> received_ports_; ///< whose messages come to this side
    std::atomic<bool> active_{false};
    std::mutex failure_mutex_;
    std::string failure_; ///< of the peer's activation
    link::Link link_;     ///< last: its threads use everything above
};

} // namespace tandem::command
