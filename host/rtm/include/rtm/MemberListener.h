// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_MEMBERLISTENER_H
#define RTC_MEMBERLISTENER_H

namespace RTC {

/// Ours: a listener that calls a member function of `object`, which must outlive it.
template <class Interface, class Object, class... Args>
class MemberListener : public Interface {
  public:
    using Function = void (Object::*)(Args...);
    MemberListener(Object& object, Function function) : m_object(object), m_function(function) {}
    void operator()(Args... args) override { (m_object.*m_function)(args...); }

  private:
    Object& m_object;
    Function m_function;
};

} // namespace RTC
#endif
