// SPDX-License-Identifier: Apache-2.0
// The manager's remote interface, RTM::Manager of Manager.idl, as OpenRTM-aist's class ManagerServant. There
// are no master and slave managers here: their lists are empty, and additions are refused. [any-thread]
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include "host/rtm/runtime/network/access.hpp"
#include <coil/stringutil.h>
#include <rtm/CORBA_SeqUtil.h>
#include <rtm/ManagerServant.h>
#include <rtm/RTObject.h>

namespace RTM {
namespace {

ModuleProfileList* to_corba(const std::vector<coil::Properties>& profiles) {
    ModuleProfileList_var list = new ModuleProfileList;
    for (const auto& profile : profiles) {
        ModuleProfile converted;
        NVUtil::copyFromProperties(converted.properties, profile);
        CORBA_SeqUtil::push_back(list.inout(), converted);
    }
    return list._retn();
}

} // namespace

RTC::ReturnCode_t ManagerServant::load_module(const char* pathname, const char* initfunc) {
    RTC::require_permission();
    return manager_.load(pathname, initfunc);
}
RTC::ReturnCode_t ManagerServant::unload_module(const char* pathname) {
    RTC::require_permission();
    return manager_.unload(pathname);
}
ModuleProfileList* ManagerServant::get_loadable_modules() { return to_corba(manager_.getLoadableModules()); }
ModuleProfileList* ManagerServant::get_loaded_modules() { return to_corba(manager_.getLoadedModules()); }
ModuleProfileList* ManagerServant::get_factory_profiles() { return to_corba(manager_.getFactoryProfiles()); }

RTC::RTObject_ptr ManagerServant::create_component(const char* module_name) {
    RTC::RTObject_impl* component = manager_.createComponent(module_name);
    return component ? component->getObjRef() : RTC::RTObject::_nil();
}

// The component exits at once; the manager's main loop deletes it later, because exit() may have been called
// from a thread that runs in it.
RTC::ReturnCode_t ManagerServant::delete_component(const char* instance_name) {
    RTC::require_permission();
    auto found = components(
        [&](auto& component) { return instance_name == std::string(component.getInstanceName()); });
    if (found->length() == 0) return RTC::BAD_PARAMETER;
    try {
        return found[0]->exit();
    } catch (const CORBA::OBJECT_NOT_EXIST&) {
        return RTC::RTC_OK; // it has exited since components()
    }
}

// Returns references instead of pointers, because any component may exit while the caller looks at the others.
RTC::RTCList_var ManagerServant::components(const std::function<bool(RTC::RTObject_impl&)>& fits) const {
    RTC::RTCList_var list = new RTC::RTCList;
    for (auto& component : manager_.impl().references(fits))
        CORBA_SeqUtil::push_back(list.inout(), component);
    return list;
}

RTC::RTCList* ManagerServant::get_components() {
    return components([](auto&) { return true; })._retn();
}

RTC::ComponentProfileList* ManagerServant::get_component_profiles() {
    RTC::ComponentProfileList_var list = new RTC::ComponentProfileList;
    for (auto& component : manager_.impl().references()) {
        try {
            CORBA_SeqUtil::push_back(list.inout(),
                                     RTC::ComponentProfile_var(component->get_component_profile()).in());
        } catch (const CORBA::OBJECT_NOT_EXIST&) {
            continue; // it has exited since references()
        }
    }
    return list._retn();
}

// `Name0`, `category/Name0`, or `*/Name0` for any category.
RTC::RTCList* ManagerServant::get_components_by_name(const char* name) {
    const std::string requested = coil::eraseHeadBlank(name);
    const std::size_t slash = requested.find('/');
    const std::string category = slash == std::string::npos ? "*" : requested.substr(0, slash);
    const std::string instance = slash == std::string::npos ? requested : requested.substr(slash + 1);
    return components([&](auto& component) {
               return instance == component.getInstanceName() &&
                      (category == "*" || category == component.getCategory());
           })
        ._retn();
}

ManagerProfile* ManagerServant::get_profile() {
    ManagerProfile_var profile = new ManagerProfile;
    const coil::Properties settings = manager_.impl().config_snapshot();
    if (const auto* node = settings.findNode("manager"))
        NVUtil::copyFromProperties(profile->properties, *node);
    NVUtil::mergeFromProperties(profile->properties, RTC::to_properties(manager_.impl().creations()));
    return profile._retn();
}

NVList* ManagerServant::get_configuration() {
    NVList_var list = new NVList;
    NVUtil::copyFromProperties(list.inout(), manager_.impl().config_snapshot());
    return list._retn();
}

// Affects components that are created and modules that are loaded from now on.
RTC::ReturnCode_t ManagerServant::set_configuration(const char* name, const char* value) {
    RTC::require_permission();
    return manager_.impl().change_setting(name, value) ? RTC::RTC_OK : RTC::BAD_PARAMETER;
}

CORBA::Boolean ManagerServant::is_master() {
    return coil::toBool(manager_.impl().setting("manager.is_master"), "YES", "NO", false);
}
ManagerList* ManagerServant::get_master_managers() { return new ManagerList; }
RTC::ReturnCode_t ManagerServant::add_master_manager(Manager_ptr) { return RTC::UNSUPPORTED; }
RTC::ReturnCode_t ManagerServant::remove_master_manager(Manager_ptr) { return RTC::BAD_PARAMETER; }
ManagerList* ManagerServant::get_slave_managers() { return new ManagerList; }
RTC::ReturnCode_t ManagerServant::add_slave_manager(Manager_ptr) { return RTC::UNSUPPORTED; }
RTC::ReturnCode_t ManagerServant::remove_slave_manager(Manager_ptr) { return RTC::BAD_PARAMETER; }
// The user or a supervisor starts processes.
RTC::ReturnCode_t ManagerServant::fork() { return RTC::UNSUPPORTED; }
RTC::ReturnCode_t ManagerServant::shutdown() {
    RTC::require_permission();
    RTC::Manager::terminate();
    return RTC::RTC_OK;
}
// Only a program that checks Manager::restartRequested() after runManager() can restart.
RTC::ReturnCode_t ManagerServant::restart() {
    RTC::require_permission();
    RTC::Manager::Impl& impl = manager_.impl();
    if (!impl.options.can_restart) return RTC::UNSUPPORTED;
    impl.restart_requested = true;
    RTC::Manager::terminate();
    return RTC::RTC_OK;
}
CORBA::Object_ptr ManagerServant::get_service(const char*) { return CORBA::Object::_nil(); }

} // namespace RTM
