// SPDX-License-Identifier: Apache-2.0
// A component as a CORBA object: construction, initialize() to exit(), and its execution contexts.
// OpenRTM-aist: class RTObject_impl; interface RTC::RTObject of the OMG RTC specification.
#include "host/crash/callback_scope.hpp"
#include "host/process/published/inventory.hpp"
#include "host/rtm/runtime/execution/configured_contexts.hpp"
#include "host/rtm/runtime/naming/local_object.hpp"
#include "host/rtm/runtime/network/access.hpp"
#include "host/rtm/runtime/sdo/organization.hpp"
#include "host/rtm/runtime/sdo/sdo_configuration.hpp"
#include "host/rtm/runtime/upcall/servant_owners.hpp"
#include <rtm/DataFlowComponentBase.h>
#include <rtm/ExecutionContextBase.h>
#include <rtm/RTObject.h>

namespace RTC {

RTObject_impl::RTObject_impl(Manager* manager)
    : m_pManager(manager), m_pORB(manager->getORB()), m_pPOA(manager->getPOA()),
      m_ownedOrganizations(std::make_shared<SDOPackage::Organizations>()),
      m_organizations(std::make_shared<SDOPackage::Organizations>()) {
    becomeServant();
}

RTObject_impl::RTObject_impl(CORBA::ORB_ptr orb, PortableServer::POA_ptr poa)
    : m_pManager(&Manager::instance()), m_pORB(CORBA::ORB::_duplicate(orb)),
      m_pPOA(PortableServer::POA::_duplicate(poa)),
      m_ownedOrganizations(std::make_shared<SDOPackage::Organizations>()),
      m_organizations(std::make_shared<SDOPackage::Organizations>()) {
    becomeServant();
}

// A component has a reference from its construction on, as in OpenRTM-aist: its ports and contexts use it.
void RTObject_impl::becomeServant() {
    m_objref = this->_this();
    m_oid = m_pPOA->servant_to_id(this);
    m_profile.parent = RTC::RTObject::_nil();
}

// The Configuration servant may still be in a call of a tool: its last reference deletes it.
RTObject_impl::~RTObject_impl() {
    tandem::process::unlist_part(this);
    set_servant_owner(this, nullptr);
    if (m_sdoConfiguration != nullptr) m_sdoConfiguration->_remove_ref();
}

DataFlowComponentBase::DataFlowComponentBase(Manager* manager) : RTObject_impl(manager) {}
DataFlowComponentBase::~DataFlowComponentBase() = default;
void DataFlowComponentBase::init() {}

// Called by RTC::Delete<T>. Deactivates the servant first, so that no new call of a tool arrives. A call that is in
// progress holds a reference and so defers the deletion.
void deleteRTObject(RTObject_impl* rtc) {
    rtc->retire();
    rtc->_remove_ref();
}

// Deactivates the servant: calls to the component now raise OBJECT_NOT_EXIST.
void RTObject_impl::retire() {
    tandem::process::unlist_part(this);
    try {
        m_pPOA->deactivate_object(m_oid.in());
    } catch (const CORBA::Exception&) {
        // already deactivated, or the ORB has been shut down
    }
}

// Contexts are created before onInitialize, which may use them, and start after it. Any tool can call this
// through CORBA, so only the first call counts.
ReturnCode_t RTObject_impl::initialize() {
    if (m_initialized.exchange(true)) return PRECONDITION_NOT_MET;
    std::vector<std::string> listed{"component", getInstanceName(), getTypeName(), "", ""};
    for (auto& name : getNamingNames()) listed.push_back(std::move(name));
    tandem::process::list_part(this, listed);
    createContexts();
    const ReturnCode_t result = on_initialize();
    if (result != RTC_OK) return result;
    m_created = false;
    // Most programs have no SDO services; without types of them the Configuration servant is not created.
    if (!SdoServiceProviderFactory::instance().getIdentifiers().empty()) {
        SDOPackage::Configuration_var created = get_configuration();
        m_sdoConfiguration->services().start_providers();
    }
    for (auto* context : m_eclist) context->start();
    return RTC_OK;
}

// Creates the contexts that the settings ask for (configured_contexts()), and binds this component to each as its
// owner. Throws ManagerError.
void RTObject_impl::createContexts() {
    for (auto& options : configured_contexts(m_properties)) {
        ExecutionContextBase* context = m_pManager->createContext(options.getProperty("type").c_str());
        if (context == nullptr)
            throw ManagerError("there is no execution context type " + options.getProperty("type") +
                               "; load the module that has it, or correct execution_contexts");
        context->init(options);
        m_eclist.push_back(context);
        context->bindComponent(this);
    }
}

// Any tool can call this through CORBA. finish() does the work, as the last step of exit() only: a component
// whose contexts still run must not be finalized.
ReturnCode_t RTObject_impl::finalize() { return PRECONDITION_NOT_MET; }

// The end of a component whose contexts have stopped, in the reverse order of initialize(): onFinalize may
// still use ports and contexts. The manager comes last, because it may delete the component at any time after.
ReturnCode_t RTObject_impl::finish() {
    {
        std::lock_guard<std::mutex> lock(m_contextsMutex);
        m_ecOther.clear();
    }
    const ReturnCode_t result = on_finalize();
    finalizePorts();
    if (m_sdoConfiguration != nullptr)
        m_sdoConfiguration->services().finalize(); // their threads ask for contexts
    finalizeContexts();
    if (m_sdoConfiguration != nullptr) m_sdoConfiguration->retire();
    retire();
    m_pManager->notifyFinalized(this);
    return result;
}

namespace {

// The component may have exited meanwhile, and then its object may have been deleted.
void exit_unless_gone(RTObject_ptr component) {
    try {
        component->exit();
    } catch (const CORBA::SystemException&) {
        return; // OBJECT_NOT_EXIST
    }
}

// Deactivates the components of others that run in this context, which ends. OpenRTM-aist stops calling them instead.
void deactivate_participants(ExecutionContextBase& context) {
    ExecutionContextProfile_var profile = context.getProfile();
    for (CORBA::ULong i = 0; i < profile->participants.length(); ++i)
        if (context.getComponentState(profile->participants[i]) == ACTIVE_STATE)
            context.deactivateComponent(profile->participants[i]);
}

} // namespace

// Leaves composites, stops the component's own contexts, leaves the contexts of other components, and finalizes. Calls
// after the first return at once. A context that does not stop is still in a callback of this component; the component
// then remains unchanged.
ReturnCode_t RTObject_impl::exit() {
    require_permission();
    if (m_created) return PRECONDITION_NOT_MET;
    if (m_exiting) return RTC_OK;
    for (auto* context : m_eclist) {
        if (!context->isInsideCycle()) continue; // of the calling thread
        // The component's own callback is the caller: a context cannot be stopped from within its cycle.
        m_pManager->invoke([self = RTObject_var(getObjRef())] { exit_unless_gone(self.in()); });
        return RTC_OK;
    }
    if (m_exiting.exchange(true)) return RTC_OK; // another thread was faster
    m_organizations->leave_all(getInstanceName());
    RTObject_var self = getObjRef();
    ReturnCode_t stopped = RTC_OK;
    for (auto* context : m_eclist) {
        if (context->stopThread() != RTC_OK) { // waits for the running callback
            stopped = RTC_ERROR;
            continue;
        }
        if (context->getComponentState(self.in()) == ACTIVE_STATE) context->deactivateComponent(self.in());
        deactivate_participants(*context);
        context->stop();
    }
    // Copied, because these contexts call detach_context(), which takes the mutex.
    std::vector<ExecutionContext_var> others;
    {
        std::lock_guard<std::mutex> lock(m_contextsMutex);
        others = m_ecOther;
    }
    for (auto& context : others) {
        try {
            if (CORBA::is_nil(context.in())) continue;
            context->deactivate_component(self.in());
            context->remove_component(self.in());
        } catch (const CORBA::SystemException&) {
            continue; // the context's process has ended
        }
    }
    if (stopped != RTC_OK) {
        const auto running = tandem::crash::find_running_callback(this);
        RTC_ERROR(("%s does not return; the component is not finalized",
                   running ? running->name : "a callback in its execution context"));
        return RTC_ERROR;
    }
    return finish();
}

// Disconnects and deactivates all ports. They are members of the derived class, so they are not deleted here.
void RTObject_impl::finalizePorts() {
    m_portAdmin.finalizePorts();
    m_inports.clear();
    m_outports.clear();
}

// Contexts are retired first, because tools must not call a context that is being deleted.
void RTObject_impl::finalizeContexts() {
    for (auto* context : m_eclist) {
        context->retire();
        deleteExecutionContext(context);
    }
    m_eclist.clear();
    std::lock_guard<std::mutex> lock(m_contextsMutex);
    m_ecMine.clear();
}

// Returns true if the component is alive in a context, own or attached, as the RTC specification defines it.
CORBA::Boolean RTObject_impl::is_alive(ExecutionContext_ptr exec_context) {
    return get_context_handle(exec_context) >= 0;
}

// Ids below ECOTHER_OFFSET are indices of the component's own contexts. The others are contexts of other components
// that it participates in.
ExecutionContext_ptr RTObject_impl::get_context(UniqueId ec_id) {
    std::lock_guard<std::mutex> lock(m_contextsMutex);
    const auto& list = ec_id < ECOTHER_OFFSET ? m_ecMine : m_ecOther;
    const auto index = static_cast<std::size_t>(ec_id < ECOTHER_OFFSET ? ec_id : ec_id - ECOTHER_OFFSET);
    return ec_id < 0 || index >= list.size() ? ExecutionContext::_nil()
                                             : ExecutionContext::_duplicate(list[index].in());
}

namespace {

// Without the nil entries of detached contexts.
ExecutionContextList* to_list(const std::vector<ExecutionContext_var>& contexts) {
    ExecutionContextList_var list = new ExecutionContextList;
    for (auto& context : contexts)
        if (!CORBA::is_nil(context.in())) CORBA_SeqUtil::push_back(list.inout(), context);
    return list._retn();
}

UniqueId index_of(const std::vector<ExecutionContext_var>& contexts, ExecutionContext_ptr context) {
    for (std::size_t i = 0; i < contexts.size(); ++i)
        if (!CORBA::is_nil(contexts[i].in()) && contexts[i]->_is_equivalent(context))
            return static_cast<UniqueId>(i);
    return -1;
}

} // namespace

ExecutionContextList* RTObject_impl::get_owned_contexts() {
    std::lock_guard<std::mutex> lock(m_contextsMutex);
    return to_list(m_ecMine);
}

ExecutionContextList* RTObject_impl::get_participating_contexts() {
    std::lock_guard<std::mutex> lock(m_contextsMutex);
    return to_list(m_ecOther);
}

// Returns the id by which get_context() finds this context; -1 if the component does not take part in it.
ExecutionContextHandle_t RTObject_impl::get_context_handle(ExecutionContext_ptr context) {
    if (CORBA::is_nil(context)) return -1;
    std::lock_guard<std::mutex> lock(m_contextsMutex);
    const UniqueId mine = index_of(m_ecMine, context);
    if (mine >= 0) return mine;
    const UniqueId other = index_of(m_ecOther, context);
    return other >= 0 ? other + ECOTHER_OFFSET : -1;
}

// Binds an own context. attach_context() binds a context of another component.
UniqueId RTObject_impl::bindContext(ExecutionContext_ptr context) {
    if (CORBA::is_nil(context)) return -1;
    UniqueId id;
    {
        std::lock_guard<std::mutex> lock(m_contextsMutex);
        m_ecMine.push_back(ExecutionContext::_duplicate(context));
        id = static_cast<UniqueId>(m_ecMine.size()) - 1;
    }
    m_actionListeners.ecaction_[0].forEach([&](auto& listener) { listener(id); });
    return id;
}

// A context of another component calls this to take this component in. Listeners are called without the mutex, because
// they may ask for contexts.
UniqueId RTObject_impl::attach_context(ExecutionContext_ptr context) {
    if (CORBA::is_nil(context)) return -1;
    UniqueId id;
    {
        std::lock_guard<std::mutex> lock(m_contextsMutex);
        std::size_t unused = 0; // the id of a detached context is given again
        while (unused < m_ecOther.size() && !CORBA::is_nil(m_ecOther[unused].in())) ++unused;
        if (unused == m_ecOther.size()) m_ecOther.emplace_back();
        m_ecOther[unused] = ExecutionContext::_duplicate(context);
        id = static_cast<UniqueId>(unused) + ECOTHER_OFFSET;
    }
    m_actionListeners.ecaction_[0].forEach([&](auto& listener) { listener(id); });
    return id;
}

// Leaves a gap in the list, so that the ids of the other contexts do not change.
ReturnCode_t RTObject_impl::detach_context(UniqueId ec_id) {
    {
        std::lock_guard<std::mutex> lock(m_contextsMutex);
        const std::int64_t index = std::int64_t{ec_id} - ECOTHER_OFFSET; // 64 bits: a tool may send any id
        if (index < 0 || index >= std::ssize(m_ecOther) ||
            CORBA::is_nil(m_ecOther[static_cast<std::size_t>(index)].in()))
            return BAD_PARAMETER;
        m_ecOther[static_cast<std::size_t>(index)] = ExecutionContext::_nil();
    }
    m_actionListeners.ecaction_[1].forEach([&](auto& listener) { listener(ec_id); });
    return RTC_OK;
}

// The functions below ask the context through CORBA, which is a local call for own contexts. Rates are in Hz.
double RTObject_impl::getExecutionRate(UniqueId ec_id) {
    ExecutionContext_var context = get_context(ec_id);
    return CORBA::is_nil(context.in()) ? 0.0 : context->get_rate();
}

ReturnCode_t RTObject_impl::setExecutionRate(UniqueId ec_id, double rate) {
    ExecutionContext_var context = get_context(ec_id);
    return CORBA::is_nil(context.in()) ? BAD_PARAMETER : context->set_rate(rate);
}

ReturnCode_t RTObject_impl::activate(UniqueId ec_id) {
    ExecutionContext_var context = get_context(ec_id);
    return CORBA::is_nil(context.in()) ? BAD_PARAMETER
                                       : context->activate_component(RTObject_var(getObjRef()).in());
}
ReturnCode_t RTObject_impl::deactivate(UniqueId ec_id) {
    ExecutionContext_var context = get_context(ec_id);
    return CORBA::is_nil(context.in()) ? BAD_PARAMETER
                                       : context->deactivate_component(RTObject_var(getObjRef()).in());
}
ReturnCode_t RTObject_impl::reset(UniqueId ec_id) {
    ExecutionContext_var context = get_context(ec_id);
    return CORBA::is_nil(context.in()) ? BAD_PARAMETER
                                       : context->reset_component(RTObject_var(getObjRef()).in());
}

} // namespace RTC
