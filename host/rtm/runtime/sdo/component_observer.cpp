// SPDX-License-Identifier: Apache-2.0
// The hints are those of OpenRTM-aist's modules ComponentObserverConsumer and FSMComponentObserverConsumer, which tools parse.
#include "host/rtm/runtime/sdo/component_observer.hpp"
#include "host/rtm/runtime/sdo/message_events.hpp"
#include <coil/stringutil.h>

namespace RTC {
namespace {

template <class Listener, class... Args>
struct FunctionListener : Listener {
    explicit FunctionListener(std::function<void(Args...)> react) : react_(std::move(react)) {}
    void operator()(Args... args) override { react_(args...); }
    std::function<void(Args...)> react_;
};

bool has_heartbeat(const coil::Properties& settings, const std::string& name) {
    return coil::toBool(settings.getProperty(name + ".enable"), "YES", "NO", false);
}

std::chrono::nanoseconds heartbeat_period(const coil::Properties& settings, const std::string& name) {
    std::chrono::nanoseconds period{};
    const bool valid = coil::stringTo(period, settings.getProperty(name + ".interval").c_str());
    return valid && period >= std::chrono::milliseconds(1) ? period : std::chrono::seconds(1);
}

} // namespace

template <class Listener, class... Args, class Type, class React>
void ComponentObserver::listen(void (RTObject_impl::*add)(Type, Listener*, bool),
                               void (RTObject_impl::*remove)(Type, Listener*), Type type, React react) {
    Listener* listener = new FunctionListener<Listener, Args...>(react);
    (component().*add)(type, listener, true);
    removals_.push_back([this, remove, type, listener] { (component().*remove)(type, listener); });
}

void ComponentObserver::start(const coil::Properties& settings) {
    const auto wanted = coil::split(settings.getProperty("observed_status"), ",", true);
    auto is_wanted = [&](const char* kind) {
        return wanted.empty() || coil::includes(wanted, "ALL") || coil::includes(wanted, kind);
    };
    if (is_wanted("RTC_STATUS")) observe_states();
    if (is_wanted("EC_STATUS")) observe_contexts();
    if (is_wanted("PORT_PROFILE")) {
        observe_ports();
        if (!with_fsm_) observe_messages(settings);
    }
    if (is_wanted("CONFIGURATION")) observe_configuration();
    if (with_fsm_ && (is_wanted("FSM_STATUS") || is_wanted("FSM_STRUCTURE"))) observe_fsm();
}

void ComponentObserver::stop() {
    for (const auto& remove : removals_) remove();
    removals_.clear();
}

std::vector<ToolLink::Periodic> ComponentObserver::periodic(const coil::Properties& settings) {
    std::vector<ToolLink::Periodic> tasks;
    const char* const own =
        with_fsm_ && has_heartbeat(settings, "rtc_heartbeat") ? "rtc_heartbeat" : "heartbeat";
    if (has_heartbeat(settings, own))
        tasks.push_back({heartbeat_period(settings, own), [this] { report(Kind::heartbeat, ""); }});
    if (with_fsm_ && has_heartbeat(settings, "ec_heartbeat"))
        tasks.push_back(
            {heartbeat_period(settings, "ec_heartbeat"), [this] { report_context_heartbeats(); }});
    return tasks;
}

void ComponentObserver::report(Kind kind, const std::string& hint) const {
    CORBA::Any number, text;
    number <<= static_cast<CORBA::ULong>(kind);
    text <<= hint.c_str();
    send("update_status", {number, text});
}

// Contexts of other components are numbered from 1000.
void ComponentObserver::report_context_heartbeats() const {
    const ExecutionContextList_var own = component().get_owned_contexts();
    const ExecutionContextList_var others = component().get_participating_contexts();
    for (CORBA::ULong i = 0; i < own->length(); ++i)
        report(Kind::ec_heartbeat, "HEARTBEAT:" + std::to_string(i));
    for (CORBA::ULong i = 0; i < others->length(); ++i)
        report(Kind::ec_heartbeat, "HEARTBEAT:" + std::to_string(1000 + i));
}

void ComponentObserver::observe_action(Kind kind, PostComponentActionListenerType type,
                                       const std::string& event) {
    listen<PostComponentActionListener, UniqueId, ReturnCode_t>(
        &RTObject_impl::addPostComponentActionListener, &RTObject_impl::removePostComponentActionListener,
        type, [this, kind, event](UniqueId context, ReturnCode_t result) {
            if (result == RTC_OK) report(kind, event + std::to_string(context));
        });
}

void ComponentObserver::observe_states() {
    using Type = PostComponentActionListenerType;
    observe_action(Kind::rtc_status, Type::POST_ON_ACTIVATED, "ACTIVE:");
    observe_action(Kind::rtc_status, Type::POST_ON_DEACTIVATED, "INACTIVE:");
    observe_action(Kind::rtc_status, Type::POST_ON_RESET, "INACTIVE:");
    observe_action(Kind::rtc_status, Type::POST_ON_ABORTING, "ERROR:");
    observe_action(Kind::rtc_status, Type::POST_ON_FINALIZE, "FINALIZE:");
}

void ComponentObserver::observe_contexts() {
    using Type = PostComponentActionListenerType;
    observe_action(Kind::ec_status, Type::POST_ON_RATE_CHANGED, "RATE_CHANGED:");
    observe_action(Kind::ec_status, Type::POST_ON_STARTUP, "STARTUP:");
    observe_action(Kind::ec_status, Type::POST_ON_SHUTDOWN, "SHUTDOWN:");
    for (const auto type :
         {ExecutionContextActionListenerType::EC_ATTACHED, ExecutionContextActionListenerType::EC_DETACHED})
        listen<ExecutionContextActionListener, UniqueId>(
            &RTObject_impl::addExecutionContextActionListener,
            &RTObject_impl::removeExecutionContextActionListener, type, [this, type](UniqueId context) {
                const bool attached = type == ExecutionContextActionListenerType::EC_ATTACHED;
                report(Kind::ec_status, (attached ? "ATTACHED:" : "DETACHED:") + std::to_string(context));
            });
}

void ComponentObserver::observe_ports() {
    for (const auto type : {PortActionListenerType::ADD_PORT, PortActionListenerType::REMOVE_PORT})
        listen<PortActionListener, const PortProfile&>(
            &RTObject_impl::addPortActionListener, &RTObject_impl::removePortActionListener, type,
            [this, type](const PortProfile& port) {
                const bool added = type == PortActionListenerType::ADD_PORT;
                report(Kind::port_profile, (added ? "ADD:" : "REMOVE:") + std::string(port.name));
            });
    using Type = PortConnectRetListenerType;
    for (const auto type : {Type::ON_CONNECTED, Type::ON_DISCONNECTED})
        listen<PortConnectRetListener, const char*, ConnectorProfile&, ReturnCode_t>(
            &RTObject_impl::addPortConnectRetListener, &RTObject_impl::removePortConnectRetListener, type,
            [this, type](const char* port, ConnectorProfile&, ReturnCode_t result) {
                const bool connected = type == Type::ON_CONNECTED;
                if (result == RTC_OK)
                    report(Kind::port_profile, (connected ? "CONNECT:" : "DISCONNECT:") + std::string(port));
            });
}

void ComponentObserver::observe_messages(const coil::Properties& settings) {
    auto tell = [this](const std::string& hint) { report(Kind::port_profile, hint); };
    for (auto& remove : listen_to_messages(component(), settings, tell))
        removals_.push_back(std::move(remove));
}

void ComponentObserver::observe_configuration() {
    auto tell = [this](const char* event, const std::string& what) {
        report(Kind::configuration, event + (": " + what));
    };
    listen<ConfigurationParamListener, const char*, const char*>(
        &RTObject_impl::addConfigurationParamListener, &RTObject_impl::removeConfigurationParamListener,
        ConfigurationParamListenerType::ON_UPDATE_CONFIG_PARAM,
        [tell](const char* set, const char* parameter) {
            tell("UPDATE_CONFIG_PARAM", std::string(set) + "." + parameter);
        });
    using Set = ConfigurationSetListenerType;
    for (const auto& [type, event] : std::initializer_list<std::pair<Set, const char*>>{
             {Set::ON_SET_CONFIG_SET, "SET_CONFIG_SET"}, {Set::ON_ADD_CONFIG_SET, "ADD_CONFIG_SET"}})
        listen<ConfigurationSetListener, const coil::Properties&>(
            &RTObject_impl::addConfigurationSetListener, &RTObject_impl::removeConfigurationSetListener, type,
            [tell, event = event](const coil::Properties& set) { tell(event, set.getName()); });
    using Name = ConfigurationSetNameListenerType;
    for (const auto& [type, event] : std::initializer_list<std::pair<Name, const char*>>{
             {Name::ON_UPDATE_CONFIG_SET, "UPDATE_CONFIG_SET"},
             {Name::ON_REMOVE_CONFIG_SET, "REMOVE_CONFIG_SET"},
             {Name::ON_ACTIVATE_CONFIG_SET, "ACTIVATE_CONFIG_SET"}})
        listen<ConfigurationSetNameListener, const char*>(
            &RTObject_impl::addConfigurationSetNameListener,
            &RTObject_impl::removeConfigurationSetNameListener, type,
            [tell, event = event](const char* set) { tell(event, set); });
}

// The hint is the state and the name of the action, as PreFsmActionListener::toString() returns it.
void ComponentObserver::observe_fsm() {
    using Pre = PreFsmActionListenerType;
    for (const auto type :
         {Pre::PRE_ON_INIT, Pre::PRE_ON_ENTRY, Pre::PRE_ON_DO, Pre::PRE_ON_EXIT, Pre::PRE_ON_STATE_CHANGE})
        listen<PreFsmActionListener, const char*>(
            &RTObject_impl::addPreFsmActionListener, &RTObject_impl::removePreFsmActionListener, type,
            [this, type](const char* state) {
                report(Kind::fsm_status, std::string(state) + " " + PreFsmActionListener::toString(type));
            });
    using Post = PostFsmActionListenerType;
    for (const auto type : {Post::POST_ON_INIT, Post::POST_ON_ENTRY, Post::POST_ON_DO, Post::POST_ON_EXIT,
                            Post::POST_ON_STATE_CHANGE})
        listen<PostFsmActionListener, const char*, ReturnCode_t>(
            &RTObject_impl::addPostFsmActionListener, &RTObject_impl::removePostFsmActionListener, type,
            [this, type](const char* state, ReturnCode_t) {
                report(Kind::fsm_status, std::string(state) + " " + PostFsmActionListener::toString(type));
            });
}

} // namespace RTC
