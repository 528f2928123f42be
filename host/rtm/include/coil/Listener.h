// SPDX-License-Identifier: Apache-2.0
// Classes of OpenRTM-aist 1.x, in the global namespace as in 1.x.
#ifndef COIL_LISTENER_H
#define COIL_LISTENER_H

class ListenerBase {
  public:
    virtual ~ListenerBase() = default;
    virtual void invoke() = 0;
};

/// Calls a member function.
template <class ListenerClass, class CallbackFunc = void (ListenerClass::*)()>
class ListenerObject : public ListenerBase {
  public:
    ListenerObject(ListenerClass* object, CallbackFunc callback) : m_object(object), m_callback(callback) {}
    void invoke() override { (m_object->*m_callback)(); }

  private:
    ListenerClass* m_object;
    CallbackFunc m_callback;
};

using CallbackFunc = void (*)();

/// Calls a function.
class ListenerFunc : public ListenerBase {
  public:
    explicit ListenerFunc(CallbackFunc callback) : m_callback(callback) {}
    void invoke() override { (*m_callback)(); }

  private:
    CallbackFunc m_callback;
};
#endif
