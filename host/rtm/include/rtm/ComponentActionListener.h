// SPDX-License-Identifier: Apache-2.0
// Listeners to the life cycle of a component: called before and after each callback, and when a port or a context is
// added or removed. They run in the thread that causes the event.
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
enum class ExecutionContextActionListenerType : std::uint8_t {
    EC_ATTACHED,
    EC_DETACHED,
    EC_ACTION_LISTENER_NUM
};

// The unscoped names that components for 1.x use.
constexpr auto PRE_ON_INITIALIZE = PreComponentActionListenerType::PRE_ON_INITIALIZE;
constexpr auto PRE_ON_FINALIZE = PreComponentActionListenerType::PRE_ON_FINALIZE;
constexpr auto PRE_ON_STARTUP = PreComponentActionListenerType::PRE_ON_STARTUP;
constexpr auto PRE_ON_SHUTDOWN = PreComponentActionListenerType::PRE_ON_SHUTDOWN;
constexpr auto PRE_ON_ACTIVATED = PreComponentActionListenerType::PRE_ON_ACTIVATED;
constexpr auto PRE_ON_DEACTIVATED = PreComponentActionListenerType::PRE_ON_DEACTIVATED;
constexpr auto PRE_ON_ABORTING = PreComponentActionListenerType::PRE_ON_ABORTING;
constexpr auto PRE_ON_ERROR = PreComponentActionListenerType::PRE_ON_ERROR;
constexpr auto PRE_ON_RESET = PreComponentActionListenerType::PRE_ON_RESET;
constexpr auto PRE_ON_EXECUTE = PreComponentActionListenerType::PRE_ON_EXECUTE;
constexpr auto PRE_ON_STATE_UPDATE = PreComponentActionListenerType::PRE_ON_STATE_UPDATE;
constexpr auto PRE_ON_RATE_CHANGED = PreComponentActionListenerType::PRE_ON_RATE_CHANGED;
constexpr auto POST_ON_INITIALIZE = PostComponentActionListenerType::POST_ON_INITIALIZE;
constexpr auto POST_ON_FINALIZE = PostComponentActionListenerType::POST_ON_FINALIZE;
constexpr auto POST_ON_STARTUP = PostComponentActionListenerType::POST_ON_STARTUP;
constexpr auto POST_ON_SHUTDOWN = PostComponentActionListenerType::POST_ON_SHUTDOWN;
constexpr auto POST_ON_ACTIVATED = PostComponentActionListenerType::POST_ON_ACTIVATED;
constexpr auto POST_ON_DEACTIVATED = PostComponentActionListenerType::POST_ON_DEACTIVATED;
constexpr auto POST_ON_ABORTING = PostComponentActionListenerType::POST_ON_ABORTING;
constexpr auto POST_ON_ERROR = PostComponentActionListenerType::POST_ON_ERROR;
constexpr auto POST_ON_RESET = PostComponentActionListenerType::POST_ON_RESET;
constexpr auto POST_ON_EXECUTE = PostComponentActionListenerType::POST_ON_EXECUTE;
constexpr auto POST_ON_STATE_UPDATE = PostComponentActionListenerType::POST_ON_STATE_UPDATE;
constexpr auto POST_ON_RATE_CHANGED = PostComponentActionListenerType::POST_ON_RATE_CHANGED;
constexpr auto ADD_PORT = PortActionListenerType::ADD_PORT;
constexpr auto REMOVE_PORT = PortActionListenerType::REMOVE_PORT;
constexpr auto EC_ATTACHED = ExecutionContextActionListenerType::EC_ATTACHED;
constexpr auto EC_DETACHED = ExecutionContextActionListenerType::EC_DETACHED;
constexpr auto PRE_COMPONENT_ACTION_LISTENER_NUM =
    PreComponentActionListenerType::PRE_COMPONENT_ACTION_LISTENER_NUM;
constexpr auto POST_COMPONENT_ACTION_LISTENER_NUM =
    PostComponentActionListenerType::POST_COMPONENT_ACTION_LISTENER_NUM;
constexpr auto PORT_ACTION_LISTENER_NUM = PortActionListenerType::PORT_ACTION_LISTENER_NUM;
constexpr auto EC_ACTION_LISTENER_NUM = ExecutionContextActionListenerType::EC_ACTION_LISTENER_NUM;

/// Called before a callback of the component.
class PreComponentActionListener {
  public:
    static const char* toString(PreComponentActionListenerType type);
    virtual ~PreComponentActionListener() = default;
    virtual void operator()(UniqueId ec_id) = 0;
};
/// Called after a callback of the component, with its result.
class PostComponentActionListener {
  public:
    static const char* toString(PostComponentActionListenerType type);
    virtual ~PostComponentActionListener() = default;
    virtual void operator()(UniqueId ec_id, ReturnCode_t ret) = 0;
};
/// Called when a port is added or removed.
class PortActionListener {
  public:
    static const char* toString(PortActionListenerType type);
    virtual ~PortActionListener() = default;
    virtual void operator()(const RTC::PortProfile& profile) = 0;
};
/// Called when a context is attached or detached.
class ExecutionContextActionListener {
  public:
    static const char* toString(ExecutionContextActionListenerType type);
    virtual ~ExecutionContextActionListener() = default;
    virtual void operator()(UniqueId ec_id) = 0;
};

} // namespace RTC

extern template class RTM::util::ListenerHolder<RTC::PreComponentActionListener>;
extern template class RTM::util::ListenerHolder<RTC::PostComponentActionListener>;
extern template class RTM::util::ListenerHolder<RTC::PortActionListener>;
extern template class RTM::util::ListenerHolder<RTC::ExecutionContextActionListener>;

namespace RTC {

/// The listeners of a component, by type of event. Use at(type) as the index. [any-thread]
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
    Table<PortActionListener, PortActionListenerType, PortActionListenerType::PORT_ACTION_LISTENER_NUM>
        portaction_;
    Table<ExecutionContextActionListener, ExecutionContextActionListenerType,
          ExecutionContextActionListenerType::EC_ACTION_LISTENER_NUM>
        ecaction_;
};

} // namespace RTC
#endif
