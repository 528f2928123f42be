// SPDX-License-Identifier: Apache-2.0
// OpenRTM-aist: class Organization_impl of SdoOrganization.h. Members and owners may be in other processes, so no
// mutex is held while they are called.
#include "host/rtm/runtime/sdo/organization.hpp"
#include <coil/UUID.h>
#include <rtm/CORBA_SeqUtil.h>
#include <rtm/Manager.h>

namespace SDOPackage {

OrganizationList* Organizations::list() const {
    std::lock_guard<std::mutex> lock(mutex_);
    OrganizationList_var list = new OrganizationList;
    for (auto& organization : all_) CORBA_SeqUtil::push_back(list.inout(), organization);
    return list._retn();
}

// Compares references, not ids: comparing does not call the organizations' processes.
bool Organizations::add(Organization_ptr organization) {
    if (CORBA::is_nil(organization)) return false;
    std::lock_guard<std::mutex> lock(mutex_);
    for (auto& present : all_)
        if (present->_is_equivalent(organization)) return false;
    all_.emplace_back(Organization::_duplicate(organization));
    return true;
}

// Walks a copy, because it asks for the ids without the mutex.
bool Organizations::remove(const std::string& id) {
    OrganizationList_var present = list();
    for (CORBA::ULong i = 0; i < present->length(); ++i) {
        CORBA::String_var present_id = present[i]->get_organization_id(); // may call another process
        if (id != present_id.in()) continue;
        std::lock_guard<std::mutex> lock(mutex_);
        return std::erase_if(all_, [&](auto& o) { return o->_is_equivalent(present[i]); }) > 0;
    }
    return false;
}

// The last action of an exiting component on its organizations.
void Organizations::leave_all(const std::string& id) {
    OrganizationList_var present = list();
    for (CORBA::ULong i = 0; i < present->length(); ++i) {
        try {
            present[i]->remove_member(id.c_str());
        } catch (const CORBA::Exception&) {
            continue; // its process has ended, or it does not know the member
        }
    }
    std::lock_guard<std::mutex> lock(mutex_);
    all_.clear();
}

// A servant from its construction on; its id is a new UUID.
Organization_impl::Organization_impl(SDOSystemElement_ptr owner)
    : id_(coil::UUID_Generator().generateUUID()->to_string()), owner_(SDOSystemElement::_duplicate(owner)) {
    oid_ = RTC::Manager::instance().thePOA()->activate_object(this);
    reference_ = this->_this();
}

void Organization_impl::retire() {
    try {
        RTC::Manager::instance().thePOA()->deactivate_object(oid_.in());
    } catch (const CORBA::Exception&) {
        // the ORB has been shut down before: nothing is active any more
    }
}

OrganizationProperty* Organization_impl::get_organization_property() {
    std::lock_guard<std::mutex> lock(mutex_);
    return new OrganizationProperty(property_);
}

namespace {

CORBA::Long index_of(const NVList& properties, const char* name) {
    return CORBA_SeqUtil::find(properties, [&](const NameValue& nv) { return std::string(nv.name) == name; });
}

} // namespace

// The caller owns the copy.
CORBA::Any* Organization_impl::get_organization_property_value(const char* name) {
    std::lock_guard<std::mutex> lock(mutex_);
    const CORBA::Long index = index_of(property_.properties, name);
    if (index < 0) throw InvalidParameter("no such property");
    return new CORBA::Any(property_.properties[static_cast<CORBA::ULong>(index)].value);
}

// Replaces all properties, as in OpenRTM-aist.
CORBA::Boolean Organization_impl::add_organization_property(const OrganizationProperty& property) {
    std::lock_guard<std::mutex> lock(mutex_);
    property_ = property;
    return true;
}

CORBA::Boolean Organization_impl::set_organization_property_value(const char* name, const CORBA::Any& value) {
    if (name[0] == '\0') throw InvalidParameter("a property needs a name");
    std::lock_guard<std::mutex> lock(mutex_);
    const CORBA::Long index = index_of(property_.properties, name);
    if (index >= 0) {
        property_.properties[static_cast<CORBA::ULong>(index)].value = value;
        return true;
    }
    NameValue added;
    added.name = CORBA::string_dup(name);
    added.value = value;
    CORBA_SeqUtil::push_back(property_.properties, added);
    return true;
}

CORBA::Boolean Organization_impl::remove_organization_property(const char* name) {
    std::lock_guard<std::mutex> lock(mutex_);
    const CORBA::Long index = index_of(property_.properties, name);
    if (index < 0) throw InvalidParameter("no such property");
    CORBA_SeqUtil::erase(property_.properties, static_cast<CORBA::ULong>(index));
    return true;
}

SDOSystemElement_ptr Organization_impl::get_owner() {
    std::lock_guard<std::mutex> lock(mutex_);
    return SDOSystemElement::_duplicate(owner_.in());
}

CORBA::Boolean Organization_impl::set_owner(SDOSystemElement_ptr sdo) {
    if (CORBA::is_nil(sdo)) throw InvalidParameter("an organization needs an owner");
    std::lock_guard<std::mutex> lock(mutex_);
    owner_ = SDOSystemElement::_duplicate(sdo);
    return true;
}

SDOList* Organization_impl::get_members() {
    std::lock_guard<std::mutex> lock(mutex_);
    return new SDOList(members_);
}

// Members are not told that they are members: PeriodicECOrganization does more.
CORBA::Boolean Organization_impl::set_members(const SDOList& sdos) {
    std::lock_guard<std::mutex> lock(mutex_);
    members_ = sdos;
    return true;
}

CORBA::Boolean Organization_impl::add_members(const SDOList& sdos) {
    std::lock_guard<std::mutex> lock(mutex_);
    for (CORBA::ULong i = 0; i < sdos.length(); ++i) {
        SDO_var member = SDO::_duplicate(sdos[i]);
        CORBA_SeqUtil::push_back(members_, member);
    }
    return true;
}

// Finds the member by its SDO id, which is its instance name. Throws InvalidParameter if there is none.
CORBA::Boolean Organization_impl::remove_member(const char* id) {
    SDOList_var present = get_members();
    for (CORBA::ULong i = 0; i < present->length(); ++i) {
        CORBA::String_var member_id = present[i]->get_sdo_id(); // may call another process
        if (std::string(id) != member_id.in()) continue;
        // Searches again, because the list may have changed during the calls.
        std::lock_guard<std::mutex> lock(mutex_);
        const CORBA::Long index =
            CORBA_SeqUtil::find(members_, [&](SDO_ptr sdo) { return sdo->_is_equivalent(present[i]); });
        if (index >= 0) CORBA_SeqUtil::erase(members_, static_cast<CORBA::ULong>(index));
        return index >= 0;
    }
    throw InvalidParameter("no such member");
}

CORBA::Boolean Organization_impl::set_dependency(DependencyType dependency) {
    dependency_ = dependency;
    return true;
}

} // namespace SDOPackage
