// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_PERIODICECSHAREDCOMPOSITE_H
#define RTC_PERIODICECSHAREDCOMPOSITE_H
#include <rtm/RTObject.h>
#include <rtm/SdoOrganization.h>
#include <string>
#include <vector>

namespace RTC {
class ExecutionContextBase;
}

namespace SDOPackage {

/// The members of a composite. Moves components that join or leave between contexts.
class PeriodicECOrganization : public Organization_impl {
  public:
    PeriodicECOrganization(RTC::RTObject_impl* composite, SDOSystemElement_ptr owner);
    ~PeriodicECOrganization() override;

    /// Moves members from their own contexts to the composite's.
    CORBA::Boolean add_members(const SDOList& sdos) override;
    CORBA::Boolean set_members(const SDOList& sdos) override;
    CORBA::Boolean remove_member(const char* id) override;
    void removeAllMembers();
    /// Lists the ports that the parameter exported_ports currently names, and no others.
    void updateDelegatedPorts();
    /// Ours: requests one transition of every member, in order.
    void forAllMembers(RTC::ReturnCode_t (RTC::ExecutionContextBase::*request)(RTC::LightweightRTObject_ptr));

  protected:
    RTC::Logger rtclog;
    RTC::RTObject_impl* m_rtobj;

  private:
    RTC::ExecutionContextBase& context();
    void runOwnContexts(RTC::RTObject_ptr member, bool run);
    bool attachMember(RTC::RTObject_ptr member);
    void detachMember(RTC::RTObject_ptr member);
    void exportPortsOf(RTC::RTObject_ptr member, bool is_member);
};

} // namespace SDOPackage

namespace RTC {

/// A component that consists of others. Its members run in its execution context, one after the other. The ports
/// named by the parameter `exported_ports` (`Motor0.in, ...`) also appear as its own. `members` names components of
/// this manager; remote ones can be added through the organization.
class PeriodicECSharedComposite : public RTObject_impl {
  public:
    explicit PeriodicECSharedComposite(Manager* manager);
    ~PeriodicECSharedComposite() override;
    ReturnCode_t onInitialize() override;
    ReturnCode_t onActivated(RTC::UniqueId exec_handle) override;
    ReturnCode_t onDeactivated(RTC::UniqueId exec_handle) override;
    ReturnCode_t onReset(RTC::UniqueId exec_handle) override;
    ReturnCode_t onFinalize() override;

  protected:
    std::vector<std::string> m_members;
    SDOPackage::PeriodicECOrganization* m_org;
};

} // namespace RTC
extern "C" {
/// The module function of OpenRTM-aist that registers the type. The manager has already registered it.
void PeriodicECSharedCompositeInit(RTC::Manager* manager);
}
#endif
