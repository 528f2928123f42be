// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/arrival_listeners.hpp"
#include "proxy/adaptor/engine/directory.hpp"
#include "proxy/adaptor/mirror_ports.hpp"
#include "proxy/adaptor/mirrors.hpp"
#include "proxy/adaptor/run_state.hpp"
#include "proxy/adaptor/settings.hpp"
#include "proxy/link/link.hpp"
#include "proxy/link/task_queue.hpp"

#include <Component.h>
#include <OutputDataPort.h>
#include <OutputEventPort.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace tandem::adaptor {

/// The OPRoS side of the proxy: an ordinary OPRoS component with mirrors of the ports of the RTCs behind InterceptorComp.
/// Starting and stopping it activates and deactivates these RTCs; an RTC in ERROR puts it in ERROR, until all RTCs are
/// ACTIVE again or their host comes back. InterceptorComp shows the OPRoS components that its property `share` names as
/// RTCs.
///
/// Its output port `linkState` sends {time [s, CLOCK_MONOTONIC], sequence number, 1 up / 0 down} when the link comes up or
/// goes down, and when the component is started. Its output event port `missedDeadline` sends the name of a port whose
/// sender was silent for longer than its deadline_ms.
class AdaptorComp final : public Component, public engine::DirectoryUser, private link::LinkHandler {
  public:
    AdaptorComp();
    ~AdaptorComp() override;
    ReturnType start() override;
    ReturnType stop() override;

  protected:
    // Life cycle, in the host's threads.
    ReturnType onInitialize() override;
    ReturnType onStart() override;
    ReturnType onStop() override;
    ReturnType onReset() override;
    ReturnType onError() override;
    ReturnType onRecover() override;
    ReturnType onDestroy() override;
    // Nothing to execute: data and calls cross the link in the threads of the components.
    ReturnType onEvent(Event*) override { return OPROS_SUCCESS; }
    ReturnType onExecute() override { return OPROS_SUCCESS; }
    ReturnType onUpdated() override { return OPROS_SUCCESS; }
    ReturnType onPeriodChanged() override { return OPROS_SUCCESS; }

  private:
    // LinkHandler, in the link's threads.
    std::string check_peer_ports(link::PortTable&) override;
    void link_state_changed(bool up) override;
    void deadline_missed(const std::string& port) override;
    void peer_connected() override;
    void peer_disconnected() override;
    void peer_ports_changed() override;
    link::Reply serve(const link::Request&) override;
    std::optional<link::ReplyView> serve_known(const link::KnownRequest&, wire::MessageBuffer&) override;
    link::Reply execute_command(const link::Request&);

    void report_unknown_properties();
    void report_useless(const std::vector<std::string>& lines);
    void create_link();
    void wait_for_peer(std::chrono::milliseconds timeout);
    void close_link();
    void create_mirror_ports();
    void update_mirror_ports();
    void follow_shared_ports();
    link::PortTable peer_ports();
    void publish_late_bindings();

    link::CallStatus drive_rtc(std::string_view command);
    void activate_rtc();
    link::CallStatus activate_on_connection();
    void activate_for_new_peer();
    bool was_activated_on_connection();
    void report_inactive();
    void request_restart();
    void restart_after_error();
    bool is_restarting() const { return restarting_thread_ == std::this_thread::get_id(); }
    link::Reply send_command(std::string_view command, std::span<const std::byte> arguments = {});
    std::chrono::milliseconds timeout_of(std::string_view command);
    /// Returns the failure if the peer refused the operations.
    link::Reply publish_bindings();
    void listen_to(const link::Port& port, engine::ArrivalListener* listener);
    void publish_listened_ports();
    void publish_link_state();

    Settings settings_;
    std::unique_ptr<link::Link> link_;
    std::unique_ptr<ArrivalListeners> listeners_;      ///< uses the link
    std::unique_ptr<engine::SharedComponents> shared_; ///< uses the link
    std::mutex mutex_;                                 ///< the three below, and changes of the mirrors
    link::PortTable own_ports_, peer_ports_;
    bool mirrors_created_ = false;
    RunState run_state_;
    std::atomic<std::thread::id> restarting_thread_{}; ///< the thread that runs a restart, if any
    std::unique_ptr<link::TaskQueue> restarts_; ///< uses the link; its thread starts with the first task

    /// Held while a command about the RTC's life cycle is sent: the activation for a new connection must not follow the
    /// deactivation of a stop. Not held while a thread waits for a peer.
    std::mutex life_cycle_mutex_;
    std::uint64_t activated_connection_ = 0; ///< number of the connection on which the RTC was last activated

    std::mutex listened_ports_mutex_;
    std::set<std::string> listened_ports_; ///< ports whose messages event-driven components wait for

    std::unique_ptr<MirrorPorts> mirrors_; ///< uses the link
    OutputEventPort<std::string> missed_deadline_;
    std::mutex link_state_mutex_; ///< the members below
    OutputDataPort<std::vector<double>> link_state_;
    std::uint64_t link_state_sequence_ = 0;
};

} // namespace tandem::adaptor
