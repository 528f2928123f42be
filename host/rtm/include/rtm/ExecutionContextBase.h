// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_EXECUTIONCONTEXTBASE_H
#define RTC_EXECUTIONCONTEXTBASE_H
#include <atomic>
#include <chrono>
#include <coil/Factory.h>
#include <coil/Properties.h>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <rtm/RTC.h>
#include <rtm/SystemLogger.h>
#include <thread>
#include <vector>

#define DEFAULT_EXECUTION_RATE 1000

namespace RTC_impl {
class RTObjectStateMachine;
}

namespace RTC {
class RTObject_impl;

/// Runs the state machines of its components. A cycle carries out pending transitions of all components, then
/// their onExecute (or onError), then onStateUpdate, one component after the other in one thread.
class ExecutionContextBase {
  public:
    explicit ExecutionContextBase(const char* name);
    virtual ~ExecutionContextBase();
    ExecutionContextBase(const ExecutionContextBase&) = delete;
    ExecutionContextBase& operator=(const ExecutionContextBase&) = delete;

    /// `rate` (Hz), `phase` (ms), `sync_transition` (YES), `transition_timeout` (s), and the last two for
    /// activation, deactivation and reset alone.
    virtual void init(coil::Properties& props);
    /// Makes the component its owner and first participant.
    virtual ReturnCode_t bindComponent(RTObject_impl* rtc);

    bool isRunning() const;
    ReturnCode_t start();
    ReturnCode_t stop();
    double getRate() const;
    std::chrono::nanoseconds getPeriod() const;
    ReturnCode_t setRate(double rate);
    /// Ours: is this a rate in Hz with a period that a clock can keep?
    static bool isRate(double rate) { return rate >= 1e-6 && rate <= 1e9; }
    ExecutionKind getKind() const { return m_kind; }

    ReturnCode_t addComponent(LightweightRTObject_ptr comp);
    ReturnCode_t removeComponent(LightweightRTObject_ptr comp);
    /// With sync_transition they return when the transition is done, or RTC_ERROR when it has failed or is
    /// not done within the timeout; called from a callback of this context, they only ask for it.
    ReturnCode_t activateComponent(LightweightRTObject_ptr comp);
    ReturnCode_t deactivateComponent(LightweightRTObject_ptr comp);
    ReturnCode_t resetComponent(LightweightRTObject_ptr comp);
    LifeCycleState getComponentState(LightweightRTObject_ptr comp);
    static const char* getStateString(LifeCycleState state);

    ExecutionContextProfile* getProfile();
    ExecutionContextService_ptr getObjRef() const {
        return ExecutionContextService::_duplicate(m_objref.in());
    }
    coil::Properties getProperties() const { return m_properties; }

    /// One cycle in the calling thread; not from a callback of this context.
    void invokeWorker();
    /// Ours: ends the context's thread; cycles are over, and a transition is carried out by who asks for it.
    /// RTC_ERROR: a callback does not return.
    ReturnCode_t stopThread() { return onStopping(); }
    /// Ours: is the caller a callback of this context?
    bool isInsideCycle() const;
    /// Ours: lets go of the owner and of the reference; after that the context can be deleted.
    void retire();

  protected:
    virtual ReturnCode_t onStarted() { return RTC_OK; }
    virtual ReturnCode_t onStopping() { return RTC_OK; }
    virtual ReturnCode_t onSetRate(double) { return RTC_OK; }
    /// Has the context a thread that will carry a requested transition out? Otherwise the caller's does.
    virtual bool hasThread() const { return false; }
    virtual void onTransitionRequested() {}
    /// Adds to the properties of the profile what the context has counted.
    virtual void addStatistics(coil::Properties& /*properties*/) {}
    virtual PortableServer::ServantBase* servant() = 0;

    void setObjRef(ExecutionContextService_ptr ref) { m_objref = ExecutionContextService::_duplicate(ref); }
    /// Is there anything to do: a component that is not simply inactive?
    bool hasWork();
    /// [cycle's thread] Has what the next cycle needs in the caches.
    void warmUp();

    mutable Logger rtclog;
    coil::Properties m_properties;
    std::chrono::nanoseconds m_phase{0};
    ExecutionKind m_kind = PERIODIC;

  private:
    using Participant = std::shared_ptr<RTC_impl::RTObjectStateMachine>;
    Participant find(LightweightRTObject_ptr comp);
    // Replaced, never changed: a cycle takes it without copying.
    using Participants = std::shared_ptr<const std::vector<Participant>>;
    Participants participants() const;
    void addParticipant(Participant participant);
    /// Does who asks for a transition wait for it, and for how long?
    struct TransitionWait {
        bool sync = true;
        std::chrono::nanoseconds timeout = std::chrono::milliseconds(500);
    };
    ReturnCode_t requestTransition(LightweightRTObject_ptr comp, LifeCycleState from, LifeCycleState to,
                                   const TransitionWait& wait);
    ReturnCode_t waitForTransition(const Participant& participant, LifeCycleState to,
                                   std::chrono::nanoseconds timeout);
    void cycle(bool warm_up);
    bool setRunning(bool running); ///< false: it was so before
    void forEach(ReturnCode_t (RTC_impl::RTObjectStateMachine::*call)());

    mutable std::mutex m_mutex; // participants, rate, running
    Participants m_participants = std::make_shared<const std::vector<Participant>>();
    std::recursive_timed_mutex m_startStopMutex; // taken before m_mutex
    bool m_running = false;
    double m_rate = DEFAULT_EXECUTION_RATE;
    TransitionWait m_activation, m_deactivation, m_reset;
    RTObject_var m_owner;
    ExecutionContextService_var m_objref;

    std::timed_mutex m_cycleMutex; // held during a cycle
    std::atomic<std::thread::id> m_cycleThread{std::thread::id()};
    std::mutex m_cycleDoneMutex;
    std::condition_variable m_cycleDone;
};

/// Contexts that libraries bring along, by name; registerECFactory() is 1.x's way to do the same.
using ExecutionContextFactory = coil::GlobalFactory<ExecutionContextBase>;
using ECNewFunc = ExecutionContextBase* (*)();
using ECDeleteFunc = void (*)(ExecutionContextBase*);

/// Creators of contexts by name.
template <class T_New>
ExecutionContextBase* ECCreate() {
    return new T_New();
}
void deleteExecutionContext(ExecutionContextBase* context);
template <class T_Delete>
void ECDelete(ExecutionContextBase* context) {
    deleteExecutionContext(context);
}

/// The CORBA face of a context: `Skeleton` is one of the POA_ classes of execution contexts.
template <class Skeleton>
class ExecutionContextServant : public virtual Skeleton,
                                public virtual PortableServer::RefCountServantBase,
                                public ExecutionContextBase {
  public:
    explicit ExecutionContextServant(const char* name) : ExecutionContextBase(name) {
        RTC::ExecutionContextService_var ref = this->_this();
        setObjRef(ref.in());
    }
    CORBA::Boolean is_running() override { return isRunning(); }
    ReturnCode_t start() override { return ExecutionContextBase::start(); }
    ReturnCode_t stop() override { return ExecutionContextBase::stop(); }
    CORBA::Double get_rate() override { return getRate(); }
    ReturnCode_t set_rate(CORBA::Double rate) override { return setRate(rate); }
    ReturnCode_t add_component(LightweightRTObject_ptr comp) override { return addComponent(comp); }
    ReturnCode_t remove_component(LightweightRTObject_ptr comp) override { return removeComponent(comp); }
    ReturnCode_t activate_component(LightweightRTObject_ptr comp) override { return activateComponent(comp); }
    ReturnCode_t deactivate_component(LightweightRTObject_ptr comp) override {
        return deactivateComponent(comp);
    }
    ReturnCode_t reset_component(LightweightRTObject_ptr comp) override { return resetComponent(comp); }
    LifeCycleState get_component_state(LightweightRTObject_ptr comp) override {
        return getComponentState(comp);
    }
    ExecutionKind get_kind() override { return getKind(); }
    ExecutionContextProfile* get_profile() override { return getProfile(); }

  protected:
    PortableServer::ServantBase* servant() override { return this; }
};

} // namespace RTC

extern template class coil::GlobalFactory<RTC::ExecutionContextBase>;
#endif
