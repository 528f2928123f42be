// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_SDOORGANIZATION_H
#define RTC_SDOORGANIZATION_H
#include <mutex>
#include <rtm/RTC.h>
#include <string>

namespace SDOPackage {

/// An SDO organization that only lists its members. Derive from it for an organization that acts on them. [ORB
/// threads]
class Organization_impl : public POA_SDOPackage::Organization, public PortableServer::RefCountServantBase {
  public:
    explicit Organization_impl(SDOSystemElement_ptr owner);
    void retire();
    SDOPackage::Organization_ptr getObjRef() const {
        return SDOPackage::Organization::_duplicate(reference_.in());
    }

    char* get_organization_id() override { return CORBA::string_dup(id_.c_str()); }
    OrganizationProperty* get_organization_property() override;
    CORBA::Any* get_organization_property_value(const char* name) override;
    CORBA::Boolean add_organization_property(const OrganizationProperty& property) override;
    CORBA::Boolean set_organization_property_value(const char* name, const CORBA::Any& value) override;
    CORBA::Boolean remove_organization_property(const char* name) override;
    SDOSystemElement_ptr get_owner() override;
    CORBA::Boolean set_owner(SDOSystemElement_ptr sdo) override;
    SDOList* get_members() override;
    CORBA::Boolean set_members(const SDOList& sdos) override;
    CORBA::Boolean add_members(const SDOList& sdos) override;
    CORBA::Boolean remove_member(const char* id) override;
    DependencyType get_dependency() override { return dependency_; }
    CORBA::Boolean set_dependency(DependencyType dependency) override;

  protected:
    std::string id_;

  private:
    std::mutex mutex_;
    PortableServer::ObjectId_var oid_;
    SDOPackage::Organization_var reference_;
    SDOSystemElement_var owner_;
    SDOList members_;
    OrganizationProperty property_;
    DependencyType dependency_ = NO_DEPENDENCY;
};

} // namespace SDOPackage
#endif
