// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_RTOBJECT_H
#define RTC_RTOBJECT_H
#include <atomic>
#include <coil/Properties.h>
#include <memory>
#include <rtm/ComponentActionListener.h>
#include <rtm/ConfigAdmin.h>
#include <rtm/CorbaPort.h>
#include <rtm/FsmActionListener.h>
#include <rtm/InPortBase.h>
#include <rtm/MemberListener.h>
#include <rtm/OutPortBase.h>
#include <rtm/PortAdmin.h>
#include <rtm/PortBase.h>
#include <rtm/RTC.h>
#include <rtm/SystemLogger.h>
#include <string>
#include <vector>

/// The first handle of the contexts in which a component participates without owning them.
#define ECOTHER_OFFSET 1000

namespace SDOPackage {
class Configuration_impl;
class Organizations;
} // namespace SDOPackage

namespace RTC {
class ExecutionContextBase;
class Manager;
class SdoServiceProviderBase;

/// A component. Users derive from DataFlowComponentBase, override the on...() callbacks and add ports in
/// onInitialize(). An execution context calls the callbacks, one at a time, in its thread. If onActivated, onExecute
/// or onStateUpdate throws or does not return RTC_OK, the component enters the ERROR state.
class RTObject_impl : public virtual POA_OpenRTM::DataFlowComponent,
                      public virtual PortableServer::RefCountServantBase {
  public:
    explicit RTObject_impl(Manager* manager);
    /// For a component that is a servant of this ORB and POA. Its manager is the process's manager.
    RTObject_impl(CORBA::ORB_ptr orb, PortableServer::POA_ptr poa);
    ~RTObject_impl() override;

  protected:
    virtual ReturnCode_t onInitialize();
    virtual ReturnCode_t onFinalize();
    virtual ReturnCode_t onStartup(RTC::UniqueId ec_id);
    virtual ReturnCode_t onShutdown(RTC::UniqueId ec_id);
    virtual ReturnCode_t onActivated(RTC::UniqueId ec_id);
    virtual ReturnCode_t onDeactivated(RTC::UniqueId ec_id);
    virtual ReturnCode_t onExecute(RTC::UniqueId ec_id);
    virtual ReturnCode_t onAborting(RTC::UniqueId ec_id);
    virtual ReturnCode_t onError(RTC::UniqueId ec_id);
    virtual ReturnCode_t onReset(RTC::UniqueId ec_id);
    virtual ReturnCode_t onStateUpdate(RTC::UniqueId ec_id);
    virtual ReturnCode_t onRateChanged(RTC::UniqueId ec_id);

  public:
    // RTC::LightweightRTObject
    ReturnCode_t initialize() override;
    ReturnCode_t finalize() override;
    ReturnCode_t exit() override;
    CORBA::Boolean is_alive(ExecutionContext_ptr exec_context) override;
    ExecutionContext_ptr get_context(UniqueId ec_id) override;
    ExecutionContextList* get_owned_contexts() override;
    ExecutionContextList* get_participating_contexts() override;
    ExecutionContextHandle_t get_context_handle(ExecutionContext_ptr cxt) override;
    UniqueId attach_context(ExecutionContext_ptr exec_context) override;
    UniqueId bindContext(ExecutionContext_ptr exec_context);
    ReturnCode_t detach_context(UniqueId ec_id) override;

    // RTC::RTObject
    ComponentProfile* get_component_profile() override;
    PortServiceList* get_ports() override;

    // RTC::ComponentAction and DataFlowComponentAction, called by contexts. Each function calls the listeners and the
    // callback above, and converts exceptions to RTC_ERROR.
    ReturnCode_t on_initialize() override;
    ReturnCode_t on_finalize() override;
    ReturnCode_t on_startup(UniqueId ec_id) override;
    ReturnCode_t on_shutdown(UniqueId ec_id) override;
    ReturnCode_t on_activated(UniqueId ec_id) override;
    ReturnCode_t on_deactivated(UniqueId ec_id) override;
    ReturnCode_t on_aborting(UniqueId ec_id) override;
    ReturnCode_t on_error(UniqueId ec_id) override;
    ReturnCode_t on_reset(UniqueId ec_id) override;
    ReturnCode_t on_execute(UniqueId ec_id) override;
    ReturnCode_t on_state_update(UniqueId ec_id) override;
    ReturnCode_t on_rate_changed(UniqueId ec_id) override;

    // SDOPackage::SDO
    SDOPackage::OrganizationList* get_owned_organizations() override;
    char* get_sdo_id() override;
    char* get_sdo_type() override;
    SDOPackage::DeviceProfile* get_device_profile() override;
    SDOPackage::ServiceProfileList* get_service_profiles() override;
    SDOPackage::ServiceProfile* get_service_profile(const char* id) override;
    SDOPackage::SDOService_ptr get_sdo_service(const char* id) override;
    SDOPackage::Configuration_ptr get_configuration() override;
    SDOPackage::Monitoring_ptr get_monitoring() override;
    SDOPackage::OrganizationList* get_organizations() override;
    SDOPackage::NVList* get_status_list() override;
    CORBA::Any* get_status(const char* name) override;

    const char* getInstanceName() const { return m_profile.instance_name; }
    void setInstanceName(const char* instance_name);
    const char* getTypeName() const { return m_profile.type_name; }
    const char* getDescription() const { return m_profile.description; }
    const char* getVersion() const { return m_profile.version; }
    const char* getVendor() const { return m_profile.vendor; }
    const char* getCategory() const { return m_profile.category; }
    std::vector<std::string> getNamingNames();
    void setObjRef(RTObject_ptr rtobj);
    RTObject_ptr getObjRef() const { return RTC::RTObject::_duplicate(m_objref.in()); }
    /// Merges properties into the component's properties and updates its profile from them.
    void setProperties(const coil::Properties& prop);
    coil::Properties& getProperties() { return m_properties; }

    template <typename VarType>
    bool bindParameter(const char* param_name, VarType& var, const char* def_val,
                       bool (*trans)(VarType&, const char*) = coil::stringTo) {
        m_configsets.bindParameter(param_name, var, def_val, trans);
        return true;
    }
    ConfigAdmin& getConfigService() { return m_configsets; }
    void updateParameters(const char* config_set) { m_configsets.update(config_set); }

    bool addPort(PortBase& port);
    bool addPort(CorbaPort& port);
    /// Lists a port of another component among this component's ports. Returns false if it is already listed.
    bool addPort(PortService_ptr port);
    bool removePort(PortService_ptr port);
    bool addInPort(const char* name, InPortBase& inport);
    bool addOutPort(const char* name, OutPortBase& outport);
    bool removeInPort(InPortBase& port);
    bool removeOutPort(OutPortBase& port);
    bool removePort(PortBase& port);
    void registerPort(PortBase& port) { addPort(port); }
    void registerPort(CorbaPort& port) { addPort(port); }
    void registerInPort(const char* name, InPortBase& inport) { addInPort(name, inport); }
    void registerOutPort(const char* name, OutPortBase& outport) { addOutPort(name, outport); }
    void deletePort(PortBase& port) { removePort(port); }
    void deletePortByName(const char* port_name);
    const std::vector<InPortBase*>& getInPorts() const { return m_inports; }
    const std::vector<OutPortBase*>& getOutPorts() const { return m_outports; }
    /// Ours: all ports; like get_ports(), but as local objects.
    PortAdmin& getPortAdmin() { return m_portAdmin; }

    /// Takes ownership of the provider. Returns false if its id is in use or its init() fails.
    bool addSdoServiceProvider(const SDOPackage::ServiceProfile& profile, SdoServiceProviderBase* provider);
    bool removeSdoServiceProvider(const char* id);
    /// Returns false if no library has registered a consumer for the interface type.
    bool addSdoServiceConsumer(const SDOPackage::ServiceProfile& profile);
    bool removeSdoServiceConsumer(const char* id);

    ExecutionContext_ptr getExecutionContext(UniqueId ec_id) { return get_context(ec_id); }
    double getExecutionRate(UniqueId ec_id);
    ReturnCode_t setExecutionRate(UniqueId ec_id, double rate);
    static bool isOwnExecutionContext(UniqueId ec_id) { return ec_id < ECOTHER_OFFSET; }
    ReturnCode_t activate(UniqueId ec_id);
    ReturnCode_t deactivate(UniqueId ec_id);
    ReturnCode_t reset(UniqueId ec_id);
    /// Ours: the component's own contexts, as local objects.
    const std::vector<ExecutionContextBase*>& getOwnContexts() const { return m_eclist; }
    /// Ours: returns the callback whose failure led to ERROR; NULL if none has failed since the last activation.
    /// [any-thread]
    const char* failedCallback() const { return m_failedCallback; }

    // Short names of OpenRTM-aist.
    using PreCompActionListener = PreComponentActionListener;
    using PreCompActionListenerType = PreComponentActionListenerType;
    using PostCompActionListener = PostComponentActionListener;
    using PostCompActionListenerType = PostComponentActionListenerType;
    using ECActionListener = ExecutionContextActionListener;
    using ECActionListenerType = ExecutionContextActionListenerType;

    bool readAll();
    bool writeAll();
    /// Read all InPorts before onExecute; write all OutPorts after it. `completion`: continue after a port that
    /// failed.
    void setReadAll(bool read = true, bool completion = false);
    void setWriteAll(bool write = true, bool completion = false);
    void finalizePorts();
    void finalizeContexts();
    /// Ours: ends calls from outside.
    void retire();

    void addPreComponentActionListener(PreComponentActionListenerType type,
                                       PreComponentActionListener* listener, bool autoclean = true);
    void removePreComponentActionListener(PreComponentActionListenerType type,
                                          PreComponentActionListener* listener);
    void addPostComponentActionListener(PostComponentActionListenerType type,
                                        PostComponentActionListener* listener, bool autoclean = true);
    void removePostComponentActionListener(PostComponentActionListenerType type,
                                           PostComponentActionListener* listener);
    void addPortActionListener(PortActionListenerType type, PortActionListener* listener,
                               bool autoclean = true);
    void removePortActionListener(PortActionListenerType type, PortActionListener* listener);
    void addExecutionContextActionListener(ExecutionContextActionListenerType type,
                                           ExecutionContextActionListener* listener, bool autoclean = true);
    void removeExecutionContextActionListener(ExecutionContextActionListenerType type,
                                              ExecutionContextActionListener* listener);
    /// Listeners to the connections of all ports of the component. PortBase has the same functions for one port.
    void addPortConnectListener(PortConnectListenerType type, PortConnectListener* listener,
                                bool autoclean = true) {
        m_portConnectListeners.at(type).addListener(listener, autoclean);
    }
    void removePortConnectListener(PortConnectListenerType type, PortConnectListener* listener) {
        m_portConnectListeners.at(type).removeListener(listener);
    }
    void addPortConnectRetListener(PortConnectRetListenerType type, PortConnectRetListener* listener,
                                   bool autoclean = true) {
        m_portConnectListeners.at(type).addListener(listener, autoclean);
    }
    void removePortConnectRetListener(PortConnectRetListenerType type, PortConnectRetListener* listener) {
        m_portConnectListeners.at(type).removeListener(listener);
    }
    void addPreFsmActionListener(PreFsmActionListenerType type, PreFsmActionListener* listener,
                                 bool autoclean = true) {
        m_fsmListeners.preaction_.at(m_actionListeners.at(type)).addListener(listener, autoclean);
    }
    void removePreFsmActionListener(PreFsmActionListenerType type, PreFsmActionListener* listener) {
        m_fsmListeners.preaction_.at(m_actionListeners.at(type)).removeListener(listener);
    }
    void addPostFsmActionListener(PostFsmActionListenerType type, PostFsmActionListener* listener,
                                  bool autoclean = true) {
        m_fsmListeners.postaction_.at(m_actionListeners.at(type)).addListener(listener, autoclean);
    }
    void removePostFsmActionListener(PostFsmActionListenerType type, PostFsmActionListener* listener) {
        m_fsmListeners.postaction_.at(m_actionListeners.at(type)).removeListener(listener);
    }
    // Called by the states of its machine.
    void preOnFsmInit(const char* state);
    void postOnFsmInit(const char* state, ReturnCode_t ret);
    void preOnFsmEntry(const char* state);
    void postOnFsmEntry(const char* state, ReturnCode_t ret);
    void preOnFsmDo(const char* state);
    void postOnFsmDo(const char* state, ReturnCode_t ret);
    void preOnFsmExit(const char* state);
    void postOnFsmExit(const char* state, ReturnCode_t ret);
    void preOnFsmStateChange(const char* state);
    void postOnFsmStateChange(const char* state, ReturnCode_t ret);
    void addConfigurationParamListener(ConfigurationParamListenerType type,
                                       ConfigurationParamListener* listener, bool autoclean = true) {
        m_configsets.addConfigurationParamListener(type, listener, autoclean);
    }
    void removeConfigurationParamListener(ConfigurationParamListenerType type,
                                          ConfigurationParamListener* listener) {
        m_configsets.removeConfigurationParamListener(type, listener);
    }
    void addConfigurationSetListener(ConfigurationSetListenerType type, ConfigurationSetListener* listener,
                                     bool autoclean = true) {
        m_configsets.addConfigurationSetListener(type, listener, autoclean);
    }
    void removeConfigurationSetListener(ConfigurationSetListenerType type,
                                        ConfigurationSetListener* listener) {
        m_configsets.removeConfigurationSetListener(type, listener);
    }
    void addConfigurationSetNameListener(ConfigurationSetNameListenerType type,
                                         ConfigurationSetNameListener* listener, bool autoclean = true) {
        m_configsets.addConfigurationSetNameListener(type, listener, autoclean);
    }
    void removeConfigurationSetNameListener(ConfigurationSetNameListenerType type,
                                            ConfigurationSetNameListener* listener) {
        m_configsets.removeConfigurationSetNameListener(type, listener);
    }

    // The same functions with a member function as listener. The result can be passed to remove...().
    template <class Object>
    PreComponentActionListener* addPreComponentActionListener(PreComponentActionListenerType type,
                                                              Object& object,
                                                              void (Object::*function)(UniqueId)) {
        auto* listener = new MemberListener<PreComponentActionListener, Object, UniqueId>(object, function);
        addPreComponentActionListener(type, listener);
        return listener;
    }
    template <class Object>
    PostComponentActionListener*
    addPostComponentActionListener(PostComponentActionListenerType type, Object& object,
                                   void (Object::*function)(UniqueId, ReturnCode_t)) {
        auto* listener =
            new MemberListener<PostComponentActionListener, Object, UniqueId, ReturnCode_t>(object, function);
        addPostComponentActionListener(type, listener);
        return listener;
    }
    template <class Object>
    PortActionListener* addPortActionListener(PortActionListenerType type, Object& object,
                                              void (Object::*function)(const RTC::PortProfile&)) {
        auto* listener =
            new MemberListener<PortActionListener, Object, const RTC::PortProfile&>(object, function);
        addPortActionListener(type, listener);
        return listener;
    }
    template <class Object>
    ExecutionContextActionListener* addExecutionContextActionListener(ExecutionContextActionListenerType type,
                                                                      Object& object,
                                                                      void (Object::*function)(UniqueId)) {
        auto* listener =
            new MemberListener<ExecutionContextActionListener, Object, UniqueId>(object, function);
        addExecutionContextActionListener(type, listener);
        return listener;
    }
    template <class Object>
    PortConnectListener* addPortConnectListener(PortConnectListenerType type, Object& object,
                                                void (Object::*function)(const char*, ConnectorProfile&)) {
        auto* listener =
            new MemberListener<PortConnectListener, Object, const char*, ConnectorProfile&>(object, function);
        addPortConnectListener(type, listener);
        return listener;
    }
    template <class Object>
    PortConnectRetListener* addPortConnectRetListener(PortConnectRetListenerType type, Object& object,
                                                      void (Object::*function)(const char*, ConnectorProfile&,
                                                                               ReturnCode_t)) {
        auto* listener =
            new MemberListener<PortConnectRetListener, Object, const char*, ConnectorProfile&, ReturnCode_t>(
                object, function);
        addPortConnectRetListener(type, listener);
        return listener;
    }
    template <class Object>
    ConfigurationParamListener*
    addConfigurationParamListener(ConfigurationParamListenerType type, Object& object,
                                  void (Object::*function)(const char*, const char*)) {
        auto* listener = new MemberListener<ConfigurationParamListener, Object, const char*, const char*>(
            object, function);
        addConfigurationParamListener(type, listener);
        return listener;
    }
    template <class Object>
    ConfigurationSetListener* addConfigurationSetListener(ConfigurationSetListenerType type, Object& object,
                                                          void (Object::*function)(const coil::Properties&)) {
        auto* listener =
            new MemberListener<ConfigurationSetListener, Object, const coil::Properties&>(object, function);
        addConfigurationSetListener(type, listener);
        return listener;
    }
    template <class Object>
    ConfigurationSetNameListener* addConfigurationSetNameListener(ConfigurationSetNameListenerType type,
                                                                  Object& object,
                                                                  void (Object::*function)(const char*)) {
        auto* listener =
            new MemberListener<ConfigurationSetNameListener, Object, const char*>(object, function);
        addConfigurationSetNameListener(type, listener);
        return listener;
    }
    template <class Object>
    PreFsmActionListener* addPreFsmActionListener(PreFsmActionListenerType type, Object& object,
                                                  void (Object::*function)(const char*)) {
        auto* listener = new MemberListener<PreFsmActionListener, Object, const char*>(object, function);
        addPreFsmActionListener(type, listener);
        return listener;
    }
    template <class Object>
    PostFsmActionListener* addPostFsmActionListener(PostFsmActionListenerType type, Object& object,
                                                    void (Object::*function)(const char*, ReturnCode_t)) {
        auto* listener =
            new MemberListener<PostFsmActionListener, Object, const char*, ReturnCode_t>(object, function);
        addPostFsmActionListener(type, listener);
        return listener;
    }

  protected:
    mutable Logger rtclog{"rtobject"};
    Manager* m_pManager;
    CORBA::ORB_var m_pORB;
    PortableServer::POA_var m_pPOA;
    ComponentProfile m_profile;
    RTObject_var m_objref;
    PortAdmin m_portAdmin;
    std::vector<InPortBase*> m_inports;
    std::vector<OutPortBase*> m_outports;
    std::vector<ExecutionContextBase*> m_eclist;
    coil::Properties m_properties;
    ConfigAdmin m_configsets{m_properties.getNode("conf")};
    /// Ours: the groups of components that this one leads, and those in which it is a member.
    std::shared_ptr<SDOPackage::Organizations> m_ownedOrganizations, m_organizations;

  private:
    ReturnCode_t finish(); // the last step of exit()
    template <class Callback>
    ReturnCode_t run_guarded(const char* what, UniqueId ec_id, PreComponentActionListenerType pre,
                             PostComponentActionListenerType post, Callback callback);
    friend class RTC_impl::RTObjectStateMachine;
    void becomeServant();
    void createContexts();
    bool addNamed(const char* name, PortBase& port);

    PortableServer::ObjectId_var m_oid;
    mutable std::mutex m_contextsMutex;
    std::vector<ExecutionContext_var> m_ecMine;
    std::vector<ExecutionContext_var> m_ecOther;
    SDOPackage::Configuration_impl* m_sdoConfiguration = nullptr;
    ComponentActionListeners m_actionListeners;
    FsmActionListeners m_fsmListeners;
    PortConnectListeners m_portConnectListeners;
    std::atomic<bool> m_created{true};
    std::atomic<bool> m_initialized{false};
    std::atomic<bool> m_exiting{false};
    std::atomic<const char*> m_failedCallback{nullptr};
    bool m_errorReported = false; // onError fails once per cycle, but is reported once
    bool m_readAll = false, m_readAllCompletion = false;
    bool m_writeAll = false, m_writeAllCompletion = false;
};
using RtcBase = RTObject_impl;

} // namespace RTC
#endif
