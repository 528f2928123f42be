// SPDX-License-Identifier: Apache-2.0
#ifndef EXT_EVENTPORTX_H_
#define EXT_EVENTPORTX_H_

#include <EventCallBack.h>
#include <InputEventPort.h>
#include <OutputEventPort.h>

/// Polls event sources outside OPRoS. There are none.
inline void eventFetch() {}

/// Sets a callback like setEventCallBack(), and the port's topic, which has no effect in this host.
template <typename T, int n, typename C, typename D, typename... P>
void setTopicCallBack(InputEventPort<T, n>& port, void (C::*function)(P...), D* object,
                      const std::string& topic) {
    port.setTopic(topic);
    setEventCallBack(port, function, object);
}
template <typename T, int n, typename... P>
void setTopicCallBack(InputEventPort<T, n>& port, void (*function)(P...), const std::string& topic) {
    port.setTopic(topic);
    setEventCallBack(port, function);
}

// Take the function by name, like SET_EVENT_CALLBACK.
#define SET_TOPIC_CALLBACK(port, func, classPtr, topic) setTopicCallBack(port, &func, classPtr, topic)
#define SET_TOPIC_CALLBACK_EX(port, func, topic) setTopicCallBack(port, &func, topic)

#endif
