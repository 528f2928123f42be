// SPDX-License-Identifier: Apache-2.0
// A function that handles the events of an input event port instead of the component's onEvent().
#ifndef EVENTCALLBACK_H_
#define EVENTCALLBACK_H_

#include <Event.h>
#include <EventData.h>
#include <InputEventPort.h>
#include <ReturnType.h>
#include <archive/opros_iarchive.h>

#include <string>

/// Handles the events of one input event port instead of the component's onEvent(), in the same thread. Create it
/// with make_EventCallBack() or SET_EVENT_CALLBACK. InputEventPort::setOwner() takes ownership of it.
class EventCallBack {
  public:
    virtual ~EventCallBack() {}
    /// Decodes an event and handles it. Throws the exceptions of the archive.
    virtual ReturnType onEvent(opros::archive::iarchive& in) = 0;
    /// Handles an event of the port's type, which exists until the call returns.
    virtual ReturnType onEvent(Event* p) = 0;
};

namespace opros {
namespace detail {

// The four forms of a handler: f(Event*), f(EventData<T>*), f(id, content), f(content). The last two are not called
// for an event without content.
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

/// Looks like a port to event_codec::push(), and passes the decoded event to the callback.
struct event_relay {
    EventCallBack& callback;
    ReturnType push(Event* event) { return callback.onEvent(event); }
};

/// Base class for ports with content of type T.
template <typename T>
class typed_callback : public EventCallBack {
  public:
    virtual ReturnType onEvent(archive::iarchive& in) {
        event_relay relay = {*this};
        return event_codec<T>::push(relay, in);
    }
    virtual ReturnType onEvent(Event* p) = 0;
};

/// Calls a member function of an object, which must outlive the port.
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

/// Returns a new callback for a member function of the object, or for a function. T is the port's content type.
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
    // Owned. Without <memory>, because some components define their own shared_ptr.
    EventCallBack* const m_call;
};

} // namespace detail
} // namespace opros

/// A callback for InputEventPort::setOwner(): a member function of C or, without C, a function.
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

/// Creates a callback and passes it to the port, which deletes its previous callback. Not while events arrive.
template <typename T, int n, typename C, typename D, typename... P>
void setEventCallBack(InputEventPort<T, n>& port, void (C::*function)(P...), D* object) {
    port.setOwner(make_EventCallBack<T, C, P...>(function, object));
}
template <typename T, int n, typename... P>
void setEventCallBack(InputEventPort<T, n>& port, void (*function)(P...)) {
    port.setOwner(make_EventCallBack<T, P...>(function));
}

// Upstream's names for these functions.
#define MakeEventCallBackClassFunction(func, classPtr, contentType)                                          \
    make_EventCallBack<contentType>(func, classPtr)
#define MakeEventCallBackFunction(func, contentType) make_EventCallBack<contentType>(func)
#define SET_EVENT_CALLBACK(port, func, classPtr) setEventCallBack(port, &func, classPtr)
#define SET_EVENT_CALLBACK_EX(port, func) setEventCallBack(port, &func)

#endif
