// SPDX-License-Identifier: Apache-2.0
// A function that takes the events of an input event port, in place of the component's onEvent().
#ifndef EVENTCALLBACK_H_
#define EVENTCALLBACK_H_

#include <Event.h>
#include <EventData.h>
#include <InputEventPort.h>
#include <ReturnType.h>
#include <archive/opros_iarchive.h>

#include <string>

/// Takes the events of one input event port, in place of the component's onEvent() and in the same thread. Made with
/// make_EventCallBack() or SET_EVENT_CALLBACK, and given to InputEventPort::setOwner(), which owns it.
class EventCallBack {
  public:
    virtual ~EventCallBack() {}
    /// Decodes an event and handles it. Throws what the archive throws.
    virtual ReturnType onEvent(opros::archive::iarchive& in) = 0;
    /// The event is of the port's type and lives until the call returns.
    virtual ReturnType onEvent(Event* p) = 0;
};

namespace opros {
namespace detail {

// The four forms that a handler may have: f(Event*), f(EventData<T>*), f(id, content), f(content). The last two are
// not called for an event without a content.
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

/// What event_codec::push() takes for a port: hands the decoded event to the callback.
struct event_relay {
    EventCallBack& callback;
    ReturnType push(Event* event) { return callback.onEvent(event); }
};

/// For ports with content of type T.
template <typename T>
class typed_callback : public EventCallBack {
  public:
    virtual ReturnType onEvent(archive::iarchive& in) {
        event_relay relay = {*this};
        return event_codec<T>::push(relay, in);
    }
    virtual ReturnType onEvent(Event* p) = 0;
};

/// A member function of an object, which must outlive the port.
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

/// A new callback that calls the member function on the object, or the function. T is the port's type of content.
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
    virtual ~owned_callback() { delete m_call; }
    owned_callback(const owned_callback&) = delete;
    owned_callback& operator=(const owned_callback&) = delete;
    using typed_callback<T>::onEvent;
    virtual ReturnType onEvent(Event* p) { return m_call->onEvent(p); }

  private:
    EventCallBack* const
        m_call; // owned; without <memory>, for components that have a shared_ptr of their own
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

/// Makes a callback and gives it to the port; a callback that was there is deleted. Not while events arrive.
template <typename T, int n, typename C, typename D, typename... P>
void setEventCallBack(InputEventPort<T, n>& port, void (C::*function)(P...), D* object) {
    port.setOwner(make_EventCallBack<T, C, P...>(function, object));
}
template <typename T, int n, typename... P>
void setEventCallBack(InputEventPort<T, n>& port, void (*function)(P...)) {
    port.setOwner(make_EventCallBack<T, P...>(function));
}

// Upstream's names for the above.
#define MakeEventCallBackClassFunction(func, classPtr, contentType)                                          \
    make_EventCallBack<contentType>(func, classPtr)
#define MakeEventCallBackFunction(func, contentType) make_EventCallBack<contentType>(func)
#define SET_EVENT_CALLBACK(port, func, classPtr) setEventCallBack(port, &func, classPtr)
#define SET_EVENT_CALLBACK_EX(port, func) setEventCallBack(port, &func)

#endif
