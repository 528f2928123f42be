// SPDX-License-Identifier: Apache-2.0
// The lists of listeners of each kind, and toString() of a kind. OpenRTM-aist has the same function in
// ComponentActionListener.h, ConfigurationListener.h, FsmActionListener.h and PortConnectListener.h; programs print
// these names and match them. Each table is in the order of its enumerators.
#include <rtm/ComponentActionListener.h>
#include <rtm/ConfigurationListener.h>
#include <rtm/FsmActionListener.h>
#include <rtm/ManagerActionListener.h>
#include <rtm/PortConnectListener.h>

template class RTM::util::ListenerHolder<RTC::PreComponentActionListener>;
template class RTM::util::ListenerHolder<RTC::PostComponentActionListener>;
template class RTM::util::ListenerHolder<RTC::PortActionListener>;
template class RTM::util::ListenerHolder<RTC::ExecutionContextActionListener>;
template class RTM::util::ListenerHolder<RTC::ConfigurationParamListener>;
template class RTM::util::ListenerHolder<RTC::ConfigurationSetListener>;
template class RTM::util::ListenerHolder<RTC::ConfigurationSetNameListener>;
template class RTM::util::ListenerHolder<RTC::PreFsmActionListener>;
template class RTM::util::ListenerHolder<RTC::PostFsmActionListener>;
template class RTM::util::ListenerHolder<RTC::PortConnectListener>;
template class RTM::util::ListenerHolder<RTC::PortConnectRetListener>;
template class RTM::util::ListenerHolder<RTM::ManagerActionListener>;
template class RTM::util::ListenerHolder<RTM::ModuleActionListener>;
template class RTM::util::ListenerHolder<RTM::RtcLifecycleActionListener>;
template class RTM::util::ListenerHolder<RTM::NamingActionListener>;

namespace RTC {
namespace {

// Returns an empty name for a value that is not a kind, including the enumerator that counts the kinds.
template <class Type, std::size_t Count>
const char* name_of(Type type, const char* const (&names)[Count]) {
    const auto index = static_cast<std::size_t>(type);
    return index < Count ? names[index] : "";
}

} // namespace

const char* PreComponentActionListener::toString(PreComponentActionListenerType type) {
    static const char* const names[] = {"PRE_ON_INITIALIZE", "PRE_ON_FINALIZE",     "PRE_ON_STARTUP",
                                        "PRE_ON_SHUTDOWN",   "PRE_ON_ACTIVATED",    "PRE_ON_DEACTIVATED",
                                        "PRE_ON_ABORTING",   "PRE_ON_ERROR",        "PRE_ON_RESET",
                                        "PRE_ON_EXECUTE",    "PRE_ON_STATE_UPDATE", "PRE_ON_RATE_CHANGED"};
    return name_of(type, names);
}

const char* PostComponentActionListener::toString(PostComponentActionListenerType type) {
    static const char* const names[] = {"POST_ON_INITIALIZE", "POST_ON_FINALIZE",     "POST_ON_STARTUP",
                                        "POST_ON_SHUTDOWN",   "POST_ON_ACTIVATED",    "POST_ON_DEACTIVATED",
                                        "POST_ON_ABORTING",   "POST_ON_ERROR",        "POST_ON_RESET",
                                        "POST_ON_EXECUTE",    "POST_ON_STATE_UPDATE", "POST_ON_RATE_CHANGED"};
    return name_of(type, names);
}

const char* PortActionListener::toString(PortActionListenerType type) {
    static const char* const names[] = {"ADD_PORT", "REMOVE_PORT"};
    return name_of(type, names);
}

const char* ExecutionContextActionListener::toString(ExecutionContextActionListenerType type) {
    static const char* const names[] = {"EC_ATTACHED", "EC_DETACHED"};
    return name_of(type, names);
}

const char* ConfigurationParamListener::toString(ConfigurationParamListenerType type) {
    static const char* const names[] = {"ON_UPDATE_CONFIG_PARAM"};
    return name_of(type, names);
}

const char* ConfigurationSetListener::toString(ConfigurationSetListenerType type) {
    static const char* const names[] = {"ON_SET_CONFIG_SET", "ON_ADD_CONFIG_SET"};
    return name_of(type, names);
}

const char* ConfigurationSetNameListener::toString(ConfigurationSetNameListenerType type) {
    static const char* const names[] = {"ON_UPDATE_CONFIG_SET", "ON_REMOVE_CONFIG_SET",
                                        "ON_ACTIVATE_CONFIG_SET"};
    return name_of(type, names);
}

const char* PortConnectListener::toString(PortConnectListenerType type) {
    static const char* const names[] = {"ON_NOTIFY_CONNECT", "ON_NOTIFY_DISCONNECT",
                                        "ON_UNSUBSCRIBE_INTERFACES"};
    return name_of(type, names);
}

const char* PortConnectRetListener::toString(PortConnectRetListenerType type) {
    static const char* const names[] = {"ON_PUBLISH_INTERFACES",   "ON_CONNECT_NEXTPORT",
                                        "ON_SUBSCRIBE_INTERFACES", "ON_CONNECTED",
                                        "ON_DISCONNECT_NEXT",      "ON_DISCONNECTED"};
    return name_of(type, names);
}

const char* PreFsmActionListener::toString(PreFsmActionListenerType type) {
    static const char* const names[] = {"PRE_ON_INIT", "PRE_ON_ENTRY", "PRE_ON_DO", "PRE_ON_EXIT",
                                        "PRE_ON_STATE_CHANGE"};
    return name_of(type, names);
}

const char* PostFsmActionListener::toString(PostFsmActionListenerType type) {
    static const char* const names[] = {"POST_ON_INIT", "POST_ON_ENTRY", "POST_ON_DO", "POST_ON_EXIT",
                                        "POST_ON_STATE_CHANGE"};
    return name_of(type, names);
}

} // namespace RTC
