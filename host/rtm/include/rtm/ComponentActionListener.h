// SPDX-License-Identifier: Apache-2.0
// Callbacks around the life-cycle callbacks of a component, and around its ports and contexts.
#ifndef RTC_COMPONENTACTIONLISTENER_H
#define RTC_COMPONENTACTIONLISTENER_H
#include <array>
#include <rtm/ListenerHolder.h>
#include <rtm/RTC.h>

namespace RTC {

enum class PreComponentActionListenerType : std::uint8_t {
    PRE_ON_INITIALIZE,
    PRE_ON_FINALIZE,
    PRE_ON_STARTUP,
    PRE_ON_SHUTDOWN,
    PRE_ON_ACTIVATED,
    PRE_ON_DEACTIVATED,
    PRE_ON_ABORTING,
    PRE_ON_ERROR,
    PRE_ON_RESET,
    PRE_ON_EXECUTE,
    PRE_ON_STATE_UPDATE,
    PRE_ON_RATE_CHANGED,
    PRE_COMPONENT_ACTION_LISTENER_NUM
};
enum class PostComponentActionListenerType : std::uint8_t {
    POST_ON_INITIALIZE,
    POST_ON_FINALIZE,
    POST_ON_STARTUP,
    POST_ON_SHUTDOWN,
    POST_ON_ACTIVATED,
    POST_ON_DEACTIVATED,
    POST_ON_ABORTING,
    POST_ON_ERROR,
    POST_ON_RESET,
    POST_ON_EXECUTE,
    POST_ON_STATE_UPDATE,
    POST_ON_RATE_CHANGED,
    POST_COMPONENT_ACTION_LISTENER_NUM
};
enum class PortActionListenerType : std::uint8_t { ADD_PORT, REMOVE_PORT, PORT_ACTION_LISTENER_NUM };
enum class ExecutionContextActionListenerType : std::uint8_t { EC_ATTACHED, EC_DETACHED, EC_ACTION_LISTENER_NUM };

class PreComponentActionListener {
public:
    virtual ~PreComponentActionListener() = default;
    virtual void operator()(UniqueId ec_id) = 0;
};
class PostComponentActionListener {
public:
    virtual ~PostComponentActionListener() = default;
    virtual void operator()(UniqueId ec_id, ReturnCode_t ret) = 0;
};
class PortActionListener {
public:
    virtual ~PortActionListener() = default;
    virtual void operator()(const RTC::PortProfile& profile) = 0;
};
class ExecutionContextActionListener {
public:
    virtual ~ExecutionContextActionListener() = default;
    virtual void operator()(UniqueId ec_id) = 0;
};

/// A component's listeners by kind.
class ComponentActionListeners {
    template <class Listener, class Type, Type Count>
    using Table = std::array<RTM::util::ListenerHolder<Listener>, static_cast<std::size_t>(Count)>;

public:
    template <class Type>
    static std::size_t at(Type type) {
        return static_cast<std::size_t>(type);
    }
    Table<PreComponentActionListener, PreComponentActionListenerType,
          PreComponentActionListenerType::PRE_COMPONENT_ACTION_LISTENER_NUM>
        preaction_;
    Table<PostComponentActionListener, PostComponentActionListenerType,
          PostComponentActionListenerType::POST_COMPONENT_ACTION_LISTENER_NUM>
        postaction_;
    Table<PortActionListener, PortActionListenerType, PortActionListenerType::PORT_ACTION_LISTENER_NUM> portaction_;
    Table<ExecutionContextActionListener, ExecutionContextActionListenerType,
          ExecutionContextActionListenerType::EC_ACTION_LISTENER_NUM>
        ecaction_;
};

} // namespace RTC
#endif
