// SPDX-License-Identifier: Apache-2.0
#include <coil/stringutil.h>
#include <rtm/CORBA_SeqUtil.h>
#include <rtm/ManagerServant.h>
#include <rtm/RTObject.h>

namespace RTM {
namespace {

ModuleProfileList* to_corba(const std::vector<coil::Properties>& profiles) {
    ModuleProfileList_var list = new ModuleProfileList;
    for (const auto& profile : profiles) {
        ModuleProfile one;
        NVUtil::copyFromProperties(one.properties, profile);
        CORBA_SeqUtil::push_back(list.inout(), one);
    }
    return list._retn();
}

} // namespace

RTC::ReturnCode_t ManagerServant::load_module(const char* pathname, const char* initfunc) {
    return manager_.load(pathname, initfunc);
}
RTC::ReturnCode_t ManagerServant::unload_module(const char*) { return RTC::UNSUPPORTED; }
ModuleProfileList* ManagerServant::get_loadable_modules() { return to_corba(manager_.getLoadableModules()); }
ModuleProfileList* ManagerServant::get_loaded_modules() { return to_corba(manager_.getLoadedModules()); }
ModuleProfileList* ManagerServant::get_factory_profiles() { return to_corba(manager_.getFactoryProfiles()); }

RTC::RTObject_ptr ManagerServant::create_component(const char* module_name) {
    RTC::RTObject_impl* component = manager_.createComponent(module_name);
    return component ? component->getObjRef() : RTC::RTObject::_nil();
}

RTC::ReturnCode_t ManagerServant::delete_component(const char* instance_name) {
    RTC::RTObject_impl* component = manager_.getComponent(instance_name);
    return component ? component->exit() : RTC::BAD_PARAMETER; // deleted later, in the manager's thread
}

RTC::RTCList* ManagerServant::get_components() {
    RTC::RTCList_var list = new RTC::RTCList;
    for (auto* component : manager_.getComponents())
        CORBA_SeqUtil::push_back(list.inout(), RTC::RTObject_var(component->getObjRef()));
    return list._retn();
}

RTC::ComponentProfileList* ManagerServant::get_component_profiles() {
    RTC::ComponentProfileList_var list = new RTC::ComponentProfileList;
    for (auto* component : manager_.getComponents())
        CORBA_SeqUtil::push_back(list.inout(),
                                 RTC::ComponentProfile_var(component->get_component_profile()).in());
    return list._retn();
}

// An instance name, or `*/TYPE` for all of a type.
// `Name0`, `category/Name0`, or `*/Name0` for any category.
RTC::RTCList* ManagerServant::get_components_by_name(const char* name) {
    const std::string wanted = coil::eraseHeadBlank(name);
    const std::size_t slash = wanted.find('/');
    const std::string category = slash == std::string::npos ? "*" : wanted.substr(0, slash);
    const std::string instance = slash == std::string::npos ? wanted : wanted.substr(slash + 1);
    RTC::RTCList_var list = new RTC::RTCList;
    for (auto* component : manager_.getComponents())
        if (instance == component->getInstanceName() &&
            (category == "*" || category == component->getCategory()))
            CORBA_SeqUtil::push_back(list.inout(), RTC::RTObject_var(component->getObjRef()));
    return list._retn();
}

ManagerProfile* ManagerServant::get_profile() {
    ManagerProfile_var profile = new ManagerProfile;
    if (const auto* node = manager_.getConfig().findNode("manager"))
        NVUtil::copyFromProperties(profile->properties, *node);
    return profile._retn();
}

NVList* ManagerServant::get_configuration() {
    NVList_var list = new NVList;
    NVUtil::copyFromProperties(list.inout(), manager_.getConfig());
    return list._retn();
}

RTC::ReturnCode_t ManagerServant::set_configuration(const char* name, const char* value) {
    manager_.getConfig().setProperty(name, value);
    return RTC::RTC_OK;
}

CORBA::Boolean ManagerServant::is_master() {
    return coil::toBool(manager_.getConfig().getProperty("manager.is_master"), "YES", "NO", false);
}
ManagerList* ManagerServant::get_master_managers() { return new ManagerList; }
RTC::ReturnCode_t ManagerServant::add_master_manager(Manager_ptr) { return RTC::UNSUPPORTED; }
RTC::ReturnCode_t ManagerServant::remove_master_manager(Manager_ptr) { return RTC::BAD_PARAMETER; }
ManagerList* ManagerServant::get_slave_managers() { return new ManagerList; }
RTC::ReturnCode_t ManagerServant::add_slave_manager(Manager_ptr) { return RTC::UNSUPPORTED; }
RTC::ReturnCode_t ManagerServant::remove_slave_manager(Manager_ptr) { return RTC::BAD_PARAMETER; }
RTC::ReturnCode_t ManagerServant::fork() { return RTC::UNSUPPORTED; }
RTC::ReturnCode_t ManagerServant::shutdown() {
    RTC::Manager::terminate();
    return RTC::RTC_OK;
}
RTC::ReturnCode_t ManagerServant::restart() { return RTC::UNSUPPORTED; }
CORBA::Object_ptr ManagerServant::get_service(const char*) { return CORBA::Object::_nil(); }

} // namespace RTM
