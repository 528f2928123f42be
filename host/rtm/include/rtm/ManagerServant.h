// SPDX-License-Identifier: Apache-2.0
#ifndef RTM_MANAGERSERVANT_H
#define RTM_MANAGERSERVANT_H
#include <functional>
#include <rtm/Manager.h>
#include <rtm/idl/ManagerSkel.h>

namespace RTM {

/// The manager as a CORBA object for tools, at corbaloc:iiop:HOST:PORT/manager. Does not support OpenRTM-aist's
/// master and slave managers. [ORB threads]
class ManagerServant : public virtual POA_RTM::Manager, public virtual PortableServer::RefCountServantBase {
  public:
    explicit ManagerServant(RTC::Manager& manager) : manager_(manager) {}

    RTC::ReturnCode_t load_module(const char* pathname, const char* initfunc) override;
    RTC::ReturnCode_t unload_module(const char* pathname) override;
    ModuleProfileList* get_loadable_modules() override;
    ModuleProfileList* get_loaded_modules() override;
    ModuleProfileList* get_factory_profiles() override;
    RTC::RTObject_ptr create_component(const char* module_name) override;
    RTC::ReturnCode_t delete_component(const char* instance_name) override;
    RTC::RTCList* get_components() override;
    RTC::ComponentProfileList* get_component_profiles() override;
    RTC::RTCList* get_components_by_name(const char* name) override;
    ManagerProfile* get_profile() override;
    NVList* get_configuration() override;
    RTC::ReturnCode_t set_configuration(const char* name, const char* value) override;
    CORBA::Boolean is_master() override;
    ManagerList* get_master_managers() override;
    RTC::ReturnCode_t add_master_manager(Manager_ptr mgr) override;
    RTC::ReturnCode_t remove_master_manager(Manager_ptr mgr) override;
    ManagerList* get_slave_managers() override;
    RTC::ReturnCode_t add_slave_manager(Manager_ptr mgr) override;
    RTC::ReturnCode_t remove_slave_manager(Manager_ptr mgr) override;
    RTC::ReturnCode_t fork() override;
    RTC::ReturnCode_t shutdown() override;
    RTC::ReturnCode_t restart() override;
    CORBA::Object_ptr get_service(const char* name) override;

    /// Returns nil if manager.corba_servant is NO.
    RTM::Manager_ptr getObjRef() const { return RTM::Manager::_duplicate(m_objref.in()); }
    /// Ours: sets the result of getObjRef().
    void setObjRef(RTM::Manager_ptr ref) { m_objref = RTM::Manager::_duplicate(ref); }

  private:
    RTC::RTCList_var components(const std::function<bool(RTC::RTObject_impl&)>& fits) const;
    RTC::Manager& manager_;
    RTM::Manager_var m_objref;
};

} // namespace RTM
#endif
