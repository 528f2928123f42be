// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/sdo/tool_services.hpp"
#include <set>

namespace RTC {

/// Notifies a tool of what happens to the component: the interface ComponentObserver of OpenRTM-aist, which RTSystemEditor
/// uses, or the one of FSM4RTC (`with_fsm`), which rtshell uses. The tool chooses with `observed_status` and sets heartbeats.
class ComponentObserver : public ToolService {
  public:
    explicit ComponentObserver(bool with_fsm) : with_fsm_(with_fsm) {}

  protected:
    void start(const coil::Properties& settings) override;
    void stop() override;
    std::vector<ToolLink::Periodic> periodic(const coil::Properties& settings) override;

  private:
    // The numbers of StatusKind. Both interfaces have the first six.
    enum class Kind : CORBA::ULong {
        rtc_status = 1,
        ec_status = 2,
        port_profile = 3,
        configuration = 4,
        heartbeat = 5,
        ec_heartbeat = 6,
        fsm_status = 8
    };
    void report(Kind kind, const std::string& hint) const;
    void report_context_heartbeats() const;
    void observe_action(Kind kind, PostComponentActionListenerType type, const std::string& event);
    void observe_states();
    void observe_contexts();
    void observe_ports();
    void observe_messages(const coil::Properties& settings);
    void observe_configuration();
    void observe_fsm();
    // Adds a listener that calls `react` by `(component.*add)(type, listener, true)`, and notes how to remove it.
    template <class Listener, class... Args, class Type, class React>
    void listen(void (RTObject_impl::*add)(Type, Listener*, bool),
                void (RTObject_impl::*remove)(Type, Listener*), Type type, React react);

    const bool with_fsm_;
    std::vector<std::function<void()>> removals_;
};

} // namespace RTC
