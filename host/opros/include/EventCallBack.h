// SPDX-License-Identifier: Apache-2.0
// A function that takes the events of an input event port, in place of the component's onEvent().
#ifndef EVENTCALLBACK_H_
#define EVENTCALLBACK_H_

#include <Event.h>
#include <EventData.h>
#include <InputEventPort.h>
#include <ReturnType.h>
#include <archive/opros_iarchive.h>

#include <memory>
#include <string>

class EventCallBack {
  public:
    virtual ~EventCallBack() {}
    virtual ReturnType onEvent(opros::archive::iarchive& in) = 0;
    virtual ReturnType onEvent(Event* p) = 0;
};

namespace opros {
namespace detail {

// The four forms a handler may have.
template <typename T, typename Call>
void handle(Event* event, Call call, void (*)(Event*)) {
    call(event);
}
template <typename T, typename Call>
void handle(Event* event, Call call, void (*)(EventData<T>*)) {
    call(static_cast<EventData<T>*>(event));
}
template <typename T, typename Call>
void handle(Event* event, Call call, void (*)(const std::string&, const T&)) {
    if (const T* content = static_cast<EventData<T>*>(event)->getContentData())
        call(event->getId(), *content);
}
template <typename T, typename Call>
void handle(Event* event, Call call, void (*)(const T&)) {
    if (const T* content = static_cast<EventData<T>*>(event)->getContentData()) call(*content);
}

struct event_relay {
    EventCallBack& callback;
    ReturnType push(Event* event) { return callback.onEvent(event); }
};

template <typename T>
class typed_callback : public EventCallBack {
  public:
    virtual ReturnType onEvent(archive::iarchive& in) {
        event_relay relay = {*this};
        return event_codec<T>::push(relay, in);
    }
    virtual ReturnType onEvent(Event* p) = 0;
};

template <typename T, typename C, typename... P>
class member_callback : public typed_callback<T> {
  public:
    member_callback(void (C::*function)(P...), C* object) : m_call{function, object} {}
    virtual ReturnType onEvent(Event* p) {
        if (!m_call.object) return OPROS_INTERNAL_FAULT;
        void (*form)(P...) = 0;
        handle<T>(p, m_call, form);
        return OPROS_SUCCESS;
    }

  private:
    struct call {
        void (C::*function)(P...);
        C* object;
        void operator()(P... given) const { (object->*function)(given...); }
    };
    call m_call;
};

template <typename T, typename... P>
class function_callback : public typed_callback<T> {
  public:
    explicit function_callback(void (*function)(P...)) : m_function(function) {}
    virtual ReturnType onEvent(Event* p) {
        handle<T>(p, m_function, m_function);
        return OPROS_SUCCESS;
    }

  private:
    void (*m_function)(P...);
};

} // namespace detail
} // namespace opros

template <typename T, typename C, typename... P>
EventCallBack* make_EventCallBack(void (C::*function)(P...), C* object) {
    return new opros::detail::member_callback<T, C, P...>(function, object);
}
template <typename T, typename... P>
EventCallBack* make_EventCallBack(void (*function)(P...)) {
    return new opros::detail::function_callback<T, P...>(function);
}

namespace opros {
namespace detail {

template <typename T>
class owned_callback : public typed_callback<T> {
  public:
    explicit owned_callback(EventCallBack* call) : m_call(call) {}
    using typed_callback<T>::onEvent;
    virtual ReturnType onEvent(Event* p) { return m_call->onEvent(p); }

  private:
    const std::unique_ptr<EventCallBack> m_call;
};

} // namespace detail
} // namespace opros

/// For InputEventPort::setOwner(): a member function of C, or without C a function.
template <typename T, typename C>
class EventCallBackMethod : public opros::detail::owned_callback<T> {
  public:
    template <typename... P>
    EventCallBackMethod(void (C::*function)(P...), C* object)
        : opros::detail::owned_callback<T>(make_EventCallBack<T>(function, object)) {}
};
template <typename T>
class EventCallBackMethod<T, void> : public opros::detail::owned_callback<T> {
  public:
    template <typename... P>
    explicit EventCallBackMethod(void (*function)(P...))
        : opros::detail::owned_callback<T>(make_EventCallBack<T>(function)) {}
};

template <typename T, int n, typename C, typename D, typename... P>
void setEventCallBack(InputEventPort<T, n>& port, void (C::*function)(P...), D* object) {
    port.setOwner(make_EventCallBack<T, C, P...>(function, object));
}
template <typename T, int n, typename... P>
void setEventCallBack(InputEventPort<T, n>& port, void (*function)(P...)) {
    port.setOwner(make_EventCallBack<T, P...>(function));
}

#define MakeEventCallBackClassFunction(func, classPtr, contentType)                                          \
    make_EventCallBack<contentType>(func, classPtr)
#define MakeEventCallBackFunction(func, contentType) make_EventCallBack<contentType>(func)
#define SET_EVENT_CALLBACK(port, func, classPtr) setEventCallBack(port, &func, classPtr)
#define SET_EVENT_CALLBACK_EX(port, func) setEventCallBack(port, &func)

#endif
