// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/opros/opros_rtc.hpp"

#include "host/log/log.hpp"
#include "proxy/interceptor/engine/capabilities.hpp"
#include "proxy/interceptor/engine/manager.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace tandem::interceptor {
namespace control = link::control;
using control::ComponentState;
using link::CallStatus;

namespace {

// The manager's factory makes components without arguments; the source of the one that this thread creates.
thread_local OprosRtc::Source* source_of_creation = nullptr;

class SourceScope {
  public:
    explicit SourceScope(OprosRtc::Source& source) { source_of_creation = &source; }
    ~SourceScope() { source_of_creation = nullptr; }
    SourceScope(const SourceScope&) = delete;
    SourceScope& operator=(const SourceScope&) = delete;
};

/// Returns whether the name has none of the characters that separate arguments of a component.
bool is_plain(const std::string& name) {
    return !name.empty() && name.find_first_of("?&=,:/ \t\n") == std::string::npos;
}

} // namespace

// ---- creation and end

OprosRtc& OprosRtc::create(RTC::Manager& manager, Source source) {
    const std::string& name = source.component.name;
    if (!is_plain(name)) throw std::runtime_error(fmt::format("'{}' is not a valid name of an RTC", name));
    engine::wait_until_removed(manager, name);
    const std::string type = is_plain(source.component.type) ? source.component.type : implementation_id;
    // A context whose thread sleeps until it is woken, and which makes transitions in the thread that requests them.
    const std::string arguments = fmt::format("{}?instance_name={}&type_name={}&execution_contexts={}",
                                              implementation_id, name, type, engine::triggered_context);
    const SourceScope scope(source);
    return dynamic_cast<OprosRtc&>(engine::create_component(manager, arguments));
}

OprosRtc::OprosRtc(RTC::Manager* manager) : RTC::DataFlowComponentBase(manager) {
    if (source_of_creation) source_ = *source_of_creation;
}

OprosRtc::~OprosRtc() {
    if (!finalized_) // it could not be created
        for (const auto& key : channel_keys_) LinkBuffer::unregister_channel(key);
}

RTC::ReturnCode_t OprosRtc::onInitialize() {
    if (!source_.link) {
        log::error(
            "{}: an RTC of type {} is created for each OPRoS component that an AdaptorComp shares, and not "
            "by name",
            getInstanceName(), implementation_id);
        return RTC::RTC_ERROR;
    }
    context_ = dynamic_cast<RTC::ExtTrigExecutionContext*>(m_eclist.empty() ? nullptr : m_eclist.front());
    if (!context_) return RTC::RTC_ERROR;
    for (const auto& port : source_.ports) add_port(port);
    add_configuration();
    return RTC::RTC_OK;
}

RTC::ReturnCode_t OprosRtc::onFinalize() {
    if (!source_.link) return RTC::RTC_OK;
    if (must_tell_component()) command(control::exit, control::deactivation_timeout);
    {
        // The task thread may be in the execution context, which is taken from this RTC after this callback, or adding a port.
        const std::unique_lock following(follow_mutex_, control::deactivation_timeout);
        finalized_ = true;
    }
    for (std::size_t i = 0; auto* output = output_at(i); ++i)
        source_.link->set_arrival_listener(source_.link->reader(output->source), {});
    for (const auto& key : channel_keys_) LinkBuffer::unregister_channel(key);
    source_.finalized();
    return RTC::RTC_OK;
}

void OprosRtc::leave(RTC::Manager& manager) {
    leaving_ = true;
    if (!finalized_) engine::remove_component(manager, *this);
}

/// Returns whether a transition must be sent to the component: not if this RTC only follows it, if this host is ending, or if
/// the link is down.
bool OprosRtc::must_tell_component() const {
    return !leaving_ && !is_following() && !engine::is_terminating() && source_.link->is_up();
}

/// One cycle handles all messages that arrived before it. [notifier-thread]
void OprosRtc::wake() {
    if constexpr (!engine::has_immediate_transitions) {
        // A tick may be forgotten, or wait for a period.
        if (!finalized_ && state() == RTC::ACTIVE_STATE) forward();
        return;
    }
    if (!wake_pending_.exchange(true)) context_->tick();
}

void OprosRtc::forward() {
    const std::lock_guard lock(forward_mutex_);
    for (std::size_t i = 0; auto* output = output_at(i); ++i) output->port->forward();
}

bool OprosRtc::is_following() const {
    // Without immediate transitions the callbacks run in the thread of the context.
    const auto follower = follower_.load();
    return engine::has_immediate_transitions ? follower == std::this_thread::get_id()
                                             : follower != std::thread::id();
}

// ---- state

bool OprosRtc::remember(const control::StateReport& report) {
    const std::lock_guard lock(state_mutex_);
    if (peer_is_there_ && report.sequence <= sequence_) return false;
    peer_is_there_ = true;
    sequence_ = report.sequence;
    component_state_ = report.state;
    fault_ = report.state == ComponentState::error;
    return true;
}

void OprosRtc::peer_lost() {
    const std::lock_guard lock(state_mutex_);
    peer_is_there_ = false;
    sequence_ = 0;
    component_state_ = ComponentState::error;
    fault_ = true;
}

RTC::LifeCycleState OprosRtc::state() const { return context_->getComponentState(m_objref.in()); }

/// Goes from ACTIVE to ERROR in two cycles: the first fails, the second aborts.
void OprosRtc::fail() {
    constexpr auto pause = std::chrono::milliseconds(5);
    for (int tick = 0; !engine::has_immediate_transitions && tick < 100 && state() == RTC::ACTIVE_STATE;
         ++tick) {
        context_->tick();
        std::this_thread::sleep_for(pause); // a tick during a cycle is forgotten
    }
    for (int cycle = 0; cycle < 2; ++cycle) context_->tick();
}

// The context carries out each transition in this thread, whose callbacks then do not call the component. If the context
// refuses a transition because another one is under way, the component's next report gives its result.
bool OprosRtc::follow() {
    const std::lock_guard following(follow_mutex_);
    if (finalized_) return true;
    ComponentState wanted{};
    {
        const std::lock_guard lock(state_mutex_);
        wanted = component_state_;
    }
    follower_ = std::this_thread::get_id();
    const auto self = m_objref.in();
    if (state() == RTC::ERROR_STATE && wanted != ComponentState::error) context_->resetComponent(self);
    // With a fault the activation fails, which is the way from INACTIVE to ERROR.
    if (state() == RTC::INACTIVE_STATE && wanted != ComponentState::inactive)
        context_->activateComponent(self);
    if (state() == RTC::ACTIVE_STATE && wanted == ComponentState::inactive)
        context_->deactivateComponent(self);
    if (state() == RTC::ACTIVE_STATE && wanted == ComponentState::error) fail();
    follower_ = std::thread::id();
    const auto reached = state();
    if (wanted == ComponentState::error) return reached == RTC::ERROR_STATE;
    return reached == (wanted == ComponentState::active ? RTC::ACTIVE_STATE : RTC::INACTIVE_STATE);
}

/// Sends a life-cycle command to the component; logs one line if that fails.
bool OprosRtc::command(std::string_view command, std::chrono::milliseconds timeout) {
    const auto name = control::encode_string(source_.component.name);
    const auto bound = std::max(source_.call_timeout, timeout + std::chrono::seconds(1));
    const auto reply = source_.link->call({"", command, "", name}, bound);
    std::string error = reply.text();
    if (reply.status == CallStatus::ok) {
        try {
            remember(control::decode_state_report(reply.bytes));
            return true;
        } catch (const link::LinkError& damaged) {
            error = damaged.what();
        }
    } else if (reply.status == CallStatus::timeout) {
        error = fmt::format("no reply within {} ms; InterceptorComp's parameter 'call_timeout' allows more",
                            bound.count());
    } else if (link::peer_has_gone(reply.status)) {
        error = "the OPRoS host is not running";
    }
    log::error("{}: cannot {} the OPRoS component: {}", getInstanceName(), command, error);
    return false;
}

RTC::ReturnCode_t OprosRtc::onActivated(RTC::UniqueId) {
    if (!is_following() && !command(control::activate, control::activation_timeout)) return RTC::RTC_ERROR;
    if (fault_) return RTC::RTC_ERROR;
    wake_pending_ = true;
    context_->tick(); // for messages that arrived before the activation
    return RTC::RTC_OK;
}

RTC::ReturnCode_t OprosRtc::onDeactivated(RTC::UniqueId) {
    // Also called on the way to ERROR, where there is nothing to stop.
    if (!fault_ && must_tell_component()) command(control::deactivate, control::deactivation_timeout);
    return RTC::RTC_OK;
}

RTC::ReturnCode_t OprosRtc::onReset(RTC::UniqueId) {
    if (is_following()) return RTC::RTC_OK;
    return command(control::reset, control::deactivation_timeout) ? RTC::RTC_OK : RTC::RTC_ERROR;
}

RTC::ReturnCode_t OprosRtc::onExecute(RTC::UniqueId) {
    wake_pending_ = false;
    if (fault_) return RTC::RTC_ERROR;
    forward();
    return RTC::RTC_OK;
}

} // namespace tandem::interceptor
