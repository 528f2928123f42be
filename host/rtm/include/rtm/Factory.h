// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_FACTORY_H
#define RTC_FACTORY_H
#include <atomic>
#include <coil/Properties.h>
#include <memory>
#include <rtm/NumberingPolicy.h>

namespace RTC {
class Manager;
class RTObject_impl;

using RtcNewFunc = RTObject_impl* (*)(Manager*);
using RtcDeleteFunc = void (*)(RTObject_impl*);

/// Creates a component of class T_New. For registerFactory().
template <class T_New>
RTObject_impl* Create(Manager* manager) {
    return new T_New(manager);
}
/// Releases the creator's reference. A running call from outside keeps the component until the call ends.
void deleteRTObject(RTObject_impl* rtc);
template <class T_Delete>
void Delete(RTObject_impl* rtc) {
    deleteRTObject(rtc);
}

/// Creates, names and destroys the components of one type.
class FactoryBase {
  public:
    explicit FactoryBase(const coil::Properties& profile) : m_Profile(profile) {}
    virtual ~FactoryBase() = default;
    virtual RTObject_impl* create(Manager* manager) = 0;
    virtual void destroy(RTObject_impl* comp) = 0;
    virtual coil::Properties& profile() { return m_Profile; }
    virtual int number() { return m_Number; }

  protected:
    coil::Properties m_Profile;
    std::atomic<int> m_Number{-1};
};

/// A factory that uses the two functions that a module registers.
class FactoryCXX : public FactoryBase {
  public:
    /// Takes ownership of the policy that numbers the instances. NULL means ProcessUniquePolicy.
    FactoryCXX(const coil::Properties& profile, RtcNewFunc new_func, RtcDeleteFunc delete_func,
               RTM::NumberingPolicyBase* policy = nullptr)
        : FactoryBase(profile), m_New(new_func), m_Delete(delete_func), m_policy(policy) {
        if (m_policy == nullptr) m_policy.reset(new RTM::ProcessUniquePolicy());
    }
    RTObject_impl* create(Manager* manager) override;
    void destroy(RTObject_impl* comp) override;
    /// Ours: the manager uses its address to find the library of the components.
    RtcNewFunc creator() const { return m_New; }

  private:
    RtcNewFunc m_New;
    RtcDeleteFunc m_Delete;
    std::unique_ptr<RTM::NumberingPolicyBase> m_policy;
};

} // namespace RTC
#endif
