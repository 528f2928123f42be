// SPDX-License-Identifier: Apache-2.0
// The parts common to all execution contexts, except the cycle (execution_cycle.cpp): options, start and stop,
// participants, profile.
#include "host/crash/callback_scope.hpp"
#include "host/process/published/inventory.hpp"
#include "host/rtm/runtime/execution/rt_object_state_machine.hpp"
#include "host/rtm/runtime/manager/manager_options.hpp"
#include <cmath>
#include <coil/stringutil.h>
#include <rtm/CORBA_SeqUtil.h>
#include <rtm/ExecutionContextBase.h>
#include <rtm/Manager.h>
#include <system_error>
#include <utility>

namespace RTC {

namespace {

/// Lists the context for other processes, unless it has no owner in this one. The caller holds the mutex of the context.
template <class Participants>
void list_context(const ExecutionContextBase* context, const std::string& owner, double rate, bool running,
                  const Participants& participants) {
    if (owner.empty()) return;
    const char* const kind = context->getKind() == PERIODIC ? "periodic" : "triggered";
    std::vector<std::string> fields{"context", owner, kind, std::to_string(std::llround(1e9 / rate)),
                                    running ? "1" : "0"};
    for (const auto& participant : participants)
        if (!participant->name().empty()) fields.push_back(participant->name());
    tandem::process::list_part(context, fields);
}

} // namespace

ExecutionContextBase::ExecutionContextBase(const char* name) : rtclog(name) {}
ExecutionContextBase::~ExecutionContextBase() { tandem::process::unlist_part(this); }

void deleteExecutionContext(ExecutionContextBase* context) {
    // Contexts are reference-counted servants. The last reference, which an ORB thread may hold, deletes the context.
    if (auto* servant = dynamic_cast<PortableServer::ServantBase*>(context)) servant->_remove_ref();
}

void ExecutionContextBase::init(coil::Properties& props) {
    m_properties << props;
    // Values come from files and from tools of other processes: those out of range leave the default. The
    // phase is bounded so that its nanoseconds fit into 64 bits.
    double rate = 0, phase_ms = 0;
    if (coil::stringTo(rate, m_properties.getProperty("rate").c_str()) && isRate(rate)) m_rate = rate;
    if (coil::stringTo(phase_ms, m_properties.getProperty("phase").c_str()) && std::abs(phase_ms) < 9e12)
        m_phase = std::chrono::nanoseconds(static_cast<std::int64_t>(phase_ms * 1e6));
    // `sync_transition` and `transition_timeout` first, as the default of the three kinds of transitions.
    auto set_wait = [this](const std::string& kind, TransitionWait& wait) {
        wait.sync = coil::toBool(m_properties.getProperty("sync_" + kind), "YES", "NO", wait.sync);
        std::chrono::nanoseconds timeout{0};
        coil::stringTo(timeout, m_properties.getProperty(kind + "_timeout").c_str());
        if (timeout.count() > 0) wait.timeout = timeout;
    };
    TransitionWait all;
    set_wait("transition", all);
    m_activation = m_deactivation = m_reset = all;
    set_wait("activation", m_activation);
    set_wait("deactivation", m_deactivation);
    set_wait("reset", m_reset);
}

ReturnCode_t ExecutionContextBase::bindComponent(RTObject_impl* rtc) {
    RTObject_var ref = rtc->getObjRef();
    const UniqueId id = rtc->bindContext(m_objref.in());
    if (id < 0) return RTC_ERROR;
    auto participant = std::make_shared<RTC_impl::RTObjectStateMachine>(id, ref.in()); // asks the manager
    std::lock_guard<std::mutex> lock(m_mutex);
    m_owner = ref;
    m_properties.setProperty("tick.owner", rtc->getInstanceName()); // for observers of the ticks
    addParticipant(std::move(participant));
    return RTC_OK;
}

// The caller holds m_mutex. The current cycle keeps the old list.
void ExecutionContextBase::addParticipant(Participant participant) {
    auto all = *m_participants;
    all.push_back(std::move(participant));
    m_participants = std::make_shared<const std::vector<Participant>>(std::move(all));
    list_context(this, m_properties.getProperty("tick.owner"), m_rate, m_running, *m_participants);
}

bool ExecutionContextBase::isRunning() const {
    std::lock_guard<std::mutex> lock(m_mutex);
    return m_running;
}

// Several tools may start and stop a context at the same time. Both functions take m_startStopMutex; otherwise a thread
// could be left running that nothing stops. Inside a cycle, stop() must not wait for this mutex, because another stop()
// may hold it while it waits for this very cycle. Inside a cycle, start() is refused, because it would have to wait for
// the end of the cycle. The time limit is twice that of a stop, so that a hanging callback does not block callers
// forever.
ReturnCode_t ExecutionContextBase::start() {
    if (isInsideCycle()) return PRECONDITION_NOT_MET;
    std::unique_lock<std::recursive_timed_mutex> transition(m_startStopMutex,
                                                            2 * host_options().stop_timeout);
    if (!transition || isRunning()) return PRECONDITION_NOT_MET;
    if (onStopping() != RTC_OK) return PRECONDITION_NOT_MET; // joins the thread of a stop() inside a cycle
    setRunning(true);
    forEach(&RTC_impl::RTObjectStateMachine::startup);
    if (!isRunning()) return RTC_OK; // a callback has stopped it
    try {
        return onStarted();
    } catch (const std::system_error&) { // it has no thread
        setRunning(false);
        throw;
    }
}

ReturnCode_t ExecutionContextBase::stop() {
    std::unique_lock<std::recursive_timed_mutex> transition(m_startStopMutex, std::defer_lock);
    if (!isInsideCycle() && !transition.try_lock_for(2 * host_options().stop_timeout)) return RTC_ERROR;
    if (!setRunning(false)) return PRECONDITION_NOT_MET;
    { std::lock_guard<std::mutex> lock(m_cycleDoneMutex); } // as in runCycle(): no waiter misses it
    m_cycleDone.notify_all();
    const ReturnCode_t result = onStopping();
    if (result == RTC_OK) forEach(&RTC_impl::RTObjectStateMachine::shutdown);
    return result;
}

bool ExecutionContextBase::setRunning(bool running) {
    std::lock_guard<std::mutex> lock(m_mutex);
    if (std::exchange(m_running, running) == running) return false;
    list_context(this, m_properties.getProperty("tick.owner"), m_rate, m_running, *m_participants);
    return true;
}

double ExecutionContextBase::getRate() const {
    std::lock_guard<std::mutex> lock(m_mutex);
    return m_rate;
}

std::chrono::nanoseconds ExecutionContextBase::getPeriod() const {
    return std::chrono::nanoseconds(std::llround(1e9 / getRate()));
}

// The hook and the callbacks run without m_mutex: they may ask for the rate.
ReturnCode_t ExecutionContextBase::setRate(double rate) {
    if (!isRate(rate)) return BAD_PARAMETER;
    {
        std::lock_guard<std::mutex> lock(m_mutex);
        m_rate = rate;
        list_context(this, m_properties.getProperty("tick.owner"), m_rate, m_running, *m_participants);
    }
    onSetRate(rate);
    forEach(&RTC_impl::RTObjectStateMachine::rateChanged);
    return RTC_OK;
}

void ExecutionContextBase::forEach(ReturnCode_t (RTC_impl::RTObjectStateMachine::*call)()) {
    const auto all =
        participants(); // kept for the time of the loop, since another thread may change the list
    for (auto& participant : *all) (participant.get()->*call)();
}

ExecutionContextBase::Participants ExecutionContextBase::participants() const {
    std::lock_guard<std::mutex> lock(m_mutex);
    return m_participants;
}

ExecutionContextBase::Participant ExecutionContextBase::find(LightweightRTObject_ptr comp) {
    if (CORBA::is_nil(comp)) return nullptr;
    const auto all = participants();
    for (auto& participant : *all)
        if (participant->refersTo(comp)) return participant;
    return nullptr;
}

ReturnCode_t ExecutionContextBase::addComponent(LightweightRTObject_ptr comp) {
    if (CORBA::is_nil(comp)) return BAD_PARAMETER;
    if (find(comp)) return PRECONDITION_NOT_MET;
    try {
        // Without m_mutex: the component, maybe of another process, may call this context back.
        const UniqueId id = comp->attach_context(m_objref.in());
        std::lock_guard<std::mutex> lock(m_mutex);
        addParticipant(std::make_shared<RTC_impl::RTObjectStateMachine>(id, comp));
        return RTC_OK;
    } catch (const CORBA::SystemException&) {
        return RTC_ERROR;
    }
}

namespace {

// Takes the context out of the component's list of contexts.
void detach_context(LightweightRTObject_ptr component, ExecutionContextService_ptr context,
                    const Logger& rtclog) {
    try {
        component->detach_context(component->get_context_handle(context));
    } catch (const CORBA::SystemException&) {
        RTC_WARN(("a component that was removed cannot be reached"));
    }
}

} // namespace

ReturnCode_t ExecutionContextBase::removeComponent(LightweightRTObject_ptr comp) {
    Participant removed = find(comp);
    if (!removed) return BAD_PARAMETER;
    if (removed->state() != INACTIVE_STATE) return PRECONDITION_NOT_MET;
    {
        std::lock_guard<std::mutex> lock(m_mutex);
        auto all = *m_participants;
        std::erase(all, removed);
        m_participants = std::make_shared<const std::vector<Participant>>(std::move(all));
        list_context(this, m_properties.getProperty("tick.owner"), m_rate, m_running, *m_participants);
    }
    detach_context(comp, m_objref.in(), rtclog);
    return RTC_OK;
}

LifeCycleState ExecutionContextBase::getComponentState(LightweightRTObject_ptr comp) {
    Participant participant = find(comp);
    return participant ? participant->state() : CREATED_STATE;
}

const char* ExecutionContextBase::getStateString(LifeCycleState state) {
    static const char* const names[] = {"CREATED", "INACTIVE", "ACTIVE", "ERROR"};
    return state <= ERROR_STATE ? names[state] : "unknown";
}

namespace {

// The callback that a component of this process is in, for tools that wait for a transition. The short callbacks of
// every cycle are left out, because they would only appear and disappear.
void add_callbacks(coil::Properties& properties, const RTObject_impl* component) {
    if (component != nullptr && component->failedCallback() != nullptr)
        properties.setProperty(std::string("failed.") + component->getInstanceName(),
                               component->failedCallback());
    const auto running = tandem::crash::find_running_callback(component);
    if (component == nullptr || !running || running->seconds() < 0.1) return;
    properties.setProperty("callback.component", component->getInstanceName());
    properties.setProperty("callback.name", running->name);
    properties.setProperty("callback.seconds", coil::sprintf("%.1f", running->seconds()));
}

} // namespace

ExecutionContextProfile* ExecutionContextBase::getProfile() {
    ExecutionContextProfile_var profile = new ExecutionContextProfile;
    profile->kind = m_kind;
    profile->rate = getRate();
    profile->owner = RTObject::_duplicate(m_owner.in());
    const auto all = participants();
    for (auto& participant : *all) {
        // The profile lists the owner apart from the participants.
        RTObject_var component = RTObject::_narrow(participant->reference());
        if (!CORBA::is_nil(component.in()) && !component->_is_equivalent(m_owner.in()))
            CORBA_SeqUtil::push_back(profile->participants, component);
    }
    coil::Properties properties(m_properties);
    addStatistics(properties);
    for (auto& participant : *all) add_callbacks(properties, participant->local());
    NVUtil::copyFromProperties(profile->properties, properties);
    return profile._retn();
}

void ExecutionContextBase::retire() {
    stop();
    tandem::process::unlist_part(this);
    Participants former;
    RTObject_var owner;
    {
        std::lock_guard<std::mutex> lock(m_mutex);
        former = std::exchange(m_participants, std::make_shared<const std::vector<Participant>>());
        owner = m_owner._retn();
    }
    for (const auto& participant : *former)
        if (!participant->refersTo(owner.in()))
            detach_context(participant->reference(), m_objref.in(), rtclog);
    try {
        PortableServer::POA_ptr poa = Manager::instance().thePOA();
        PortableServer::ObjectId_var id = poa->servant_to_id(servant());
        poa->deactivate_object(id.in());
    } catch (const CORBA::Exception&) {
        // Deactivated before, or the ORB was shut down first.
    }
}

} // namespace RTC
