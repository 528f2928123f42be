// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_PERIODICECSHAREDCOMPOSITE_H
#define RTC_PERIODICECSHAREDCOMPOSITE_H
#include <rtm/RTObject.h>
#include <string>
#include <vector>

namespace SDOPackage {
class PeriodicECOrganization;
}

namespace RTC {

/// A component made of others: its members run in its execution context, one after the other, and the ports
/// that the parameter `exported_ports` names (`Motor0.in, ...`) are its own as well. `members` names those of
/// this manager; remote ones can be added through its organization.
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
#endif
