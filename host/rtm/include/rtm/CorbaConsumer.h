// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_CORBACONSUMER_H
#define RTC_CORBACONSUMER_H
#include <iostream>
#include <omniORB4/CORBA.h>
#include <utility>

namespace RTC {

/// Holds the reference of a required service. CorbaPort sets it when a connection provides the service and releases
/// it when the connection ends. Not synchronized with calls through it.
class CorbaConsumerBase {
  public:
    CorbaConsumerBase() = default;
    CorbaConsumerBase(const CorbaConsumerBase& other)
        : m_objref(CORBA::Object::_duplicate(other.m_objref.in())) {}
    CorbaConsumerBase& operator=(const CorbaConsumerBase& other) {
        m_objref = CORBA::Object::_duplicate(other.m_objref.in());
        return *this;
    }
    virtual ~CorbaConsumerBase() = default;

    /// Sets the object to call. Returns false if it is nil or if this consumer cannot call it.
    virtual bool setObject(CORBA::Object_ptr obj) {
        if (CORBA::is_nil(obj)) return false;
        m_objref = CORBA::Object::_duplicate(obj);
        return true;
    }
    /// Returns the reference without duplicating it; nil while there is no provider.
    virtual CORBA::Object_ptr getObject() { return m_objref.in(); }
    virtual void releaseObject() { m_objref = CORBA::Object::_nil(); }

  protected:
    CORBA::Object_var m_objref;
};

/// A required service of one interface. Calls without a provider throw a CORBA::SystemException.
template <class ObjectType, typename ObjectTypePtr = typename ObjectType::_ptr_type,
          typename ObjectTypeVar = typename ObjectType::_var_type>
class CorbaConsumer : public CorbaConsumerBase {
  public:
    CorbaConsumer() = default;
    CorbaConsumer(const CorbaConsumer& other)
        : CorbaConsumerBase(other), m_var(ObjectType::_duplicate(other.m_var.in())) {}
    CorbaConsumer& operator=(const CorbaConsumer& other) {
        CorbaConsumerBase::operator=(other);
        m_var = ObjectType::_duplicate(other.m_var.in());
        return *this;
    }

    bool setObject(CORBA::Object_ptr obj) override {
        releaseObject();
        if (!CorbaConsumerBase::setObject(obj)) return false;
        ObjectTypeVar narrowed = ObjectType::_narrow(m_objref.in());
        if (CORBA::is_nil(narrowed.in())) {
            releaseObject();
            return false;
        }
        m_var = narrowed;
        return true;
    }
    ObjectTypePtr _ptr() { return m_var.inout(); }
    ObjectTypePtr operator->() { return m_var.inout(); }
    void releaseObject() override {
        CorbaConsumerBase::releaseObject();
        if (!CORBA::is_nil(m_var.in())) m_released = m_var;
        m_var = ObjectType::_nil();
    }

  protected:
    ObjectTypeVar m_var;
    /// keeps the last provider: a call through it may be running when the provider is lost
    ObjectTypeVar m_released;
};

} // namespace RTC
#endif
