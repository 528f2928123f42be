// SPDX-License-Identifier: Apache-2.0
// Listeners to a component's state machine (StaticFSM.h): called before and after the actions of its states.
#ifndef RTC_FSMACTIONLISTENER_H
#define RTC_FSMACTIONLISTENER_H
#include <array>
#include <cstdint>
#include <rtm/ListenerHolder.h>
#include <rtm/RTC.h>

namespace RTC {

enum class PreFsmActionListenerType : std::uint8_t {
    PRE_ON_INIT,
    PRE_ON_ENTRY,
    PRE_ON_DO,
    PRE_ON_EXIT,
    PRE_ON_STATE_CHANGE,
    PRE_FSM_ACTION_LISTENER_NUM
};
enum class PostFsmActionListenerType : std::uint8_t {
    POST_ON_INIT,
    POST_ON_ENTRY,
    POST_ON_DO,
    POST_ON_EXIT,
    POST_ON_STATE_CHANGE,
    POST_FSM_ACTION_LISTENER_NUM
};

/// Called before an action, with the name of its state.
class PreFsmActionListener {
  public:
    static const char* toString(PreFsmActionListenerType type);
    virtual ~PreFsmActionListener() = default;
    virtual void operator()(const char* state) = 0;
};
/// Called after an action, with its result.
class PostFsmActionListener {
  public:
    static const char* toString(PostFsmActionListenerType type);
    virtual ~PostFsmActionListener() = default;
    virtual void operator()(const char* state, ReturnCode_t ret) = 0;
};

} // namespace RTC

extern template class RTM::util::ListenerHolder<RTC::PreFsmActionListener>;
extern template class RTM::util::ListenerHolder<RTC::PostFsmActionListener>;

namespace RTC {

/// A component's FSM listeners by type. [any-thread]
class FsmActionListeners {
  public:
    std::array<RTM::util::ListenerHolder<PreFsmActionListener>,
               static_cast<std::size_t>(PreFsmActionListenerType::PRE_FSM_ACTION_LISTENER_NUM)>
        preaction_;
    std::array<RTM::util::ListenerHolder<PostFsmActionListener>,
               static_cast<std::size_t>(PostFsmActionListenerType::POST_FSM_ACTION_LISTENER_NUM)>
        postaction_;
};

} // namespace RTC
#endif
