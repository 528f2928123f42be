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

/// An execution context (OMG RTC 1.0): runs the life-cycle state machines of its participants. A cycle carries out
/// the pending transitions of all components, then their onExecute (or onError), then onStateUpdate, one component
/// after the other in one thread. Derived classes determine when a cycle runs. All public functions: [any-thread].
class ExecutionContextBase {
  public:
    explicit ExecutionContextBase(const char* name);
    virtual ~ExecutionContextBase();
    ExecutionContextBase(const ExecutionContextBase&) = delete;
    ExecutionContextBase& operator=(const ExecutionContextBase&) = delete;

    /// Properties: `rate` (Hz), `phase` (ms), `sync_transition` (YES), `transition_timeout` (s, 0.5), and the last
    /// two for activation, deactivation and reset alone: `sync_activation`, `activation_timeout` ... Ignores invalid
    /// values.
    virtual void init(coil::Properties& props);
    /// Makes the component the context's owner and first participant.
    virtual ReturnCode_t bindComponent(RTObject_impl* rtc);

    bool isRunning() const;
    /// Calls on_startup of all participants, then begins the cycles. Returns PRECONDITION_NOT_MET if the context
    /// already runs, a former thread of it hangs in a callback, or the caller is a callback of this context.
    ReturnCode_t start();
    /// Ends the cycles, waits for the current one, then calls on_shutdown of all participants. Returns RTC_ERROR if a
    /// callback does not return. Does not wait if called from a callback of this context.
    ReturnCode_t stop();
    double getRate() const;
    std::chrono::nanoseconds getPeriod() const;
    /// Sets the rate in Hz, from the next cycle on, and calls on_rate_changed of all participants. Returns
    /// BAD_PARAMETER unless isRate().
    ReturnCode_t setRate(double rate);
    /// Ours: returns true if this is a rate in Hz with a period between 1 ns and 11 days.
    static bool isRate(double rate) { return rate >= 1e-6 && rate <= 1e9; }
    ExecutionKind getKind() const { return m_kind; }

    /// Add or remove a participant, which may be in another process. A component can leave only while it is inactive.
    /// Return RTC_ERROR if it cannot be reached.
    ReturnCode_t addComponent(LightweightRTObject_ptr comp);
    ReturnCode_t removeComponent(LightweightRTObject_ptr comp);
    /// Request a transition, which a cycle carries out. With sync_transition, they return when the transition is
    /// done, and return RTC_ERROR if it fails or exceeds the timeout. Called from a callback of this context, they
    /// only request it. Return PRECONDITION_NOT_MET if the component is in another state or the context does not run.
    ReturnCode_t activateComponent(LightweightRTObject_ptr comp);
    ReturnCode_t deactivateComponent(LightweightRTObject_ptr comp);
    ReturnCode_t resetComponent(LightweightRTObject_ptr comp);
    /// Returns CREATED_STATE for a component that is not a participant.
    LifeCycleState getComponentState(LightweightRTObject_ptr comp);
    static const char* getStateString(LifeCycleState state);

    /// Returns a profile that the caller owns. Its properties are those of init() and the context's statistics.
    ExecutionContextProfile* getProfile();
    ExecutionContextService_ptr getObjRef() const {
        return ExecutionContextService::_duplicate(m_objref.in());
    }
    coil::Properties getProperties() const { return m_properties; }

    /// Runs one cycle in the calling thread. Not from a callback of this context.
    void invokeWorker();
    /// Ours: ends the context's thread and its cycles. Afterwards, the requesting thread carries out transitions.
    /// Returns RTC_ERROR if a callback does not return.
    ReturnCode_t stopThread() { return onStopping(); }
    /// Ours: returns true if the calling thread is inside a cycle of this context, in a callback.
    bool isInsideCycle() const;
    /// Ours: stops, drops owner and participants and deactivates the CORBA object. Afterwards the context can be
    /// deleted.
    void retire();

  protected:
    // Hooks of derived classes. If onStopping() returns an error, the context's thread hangs in a callback; it is
    // then called again before the next start.
    virtual ReturnCode_t onStarted() { return RTC_OK; }
    virtual ReturnCode_t onStopping() { return RTC_OK; }
    virtual ReturnCode_t onSetRate(double) { return RTC_OK; }
    /// Returns true if the context has a thread that carries out requested transitions. Otherwise the requesting
    /// thread does.
    virtual bool hasThread() const { return false; }
    /// Wakes this thread, which may sleep while no component is active.
    virtual void onTransitionRequested() {}
    /// Adds the context's statistics to the properties of its profile.
    virtual void addStatistics(coil::Properties& /*properties*/) {}
    virtual PortableServer::ServantBase* servant() = 0;

    void setObjRef(ExecutionContextService_ptr ref) { m_objref = ExecutionContextService::_duplicate(ref); }
    /// Returns true if a cycle has work: a component is not simply inactive.
    bool hasWork();
    /// Runs one cycle like invokeWorker(). Returns what hasWork() would.
    bool runCycle();
    /// Runs the code of the next cycle without calling a component. [cycle's thread]
    void rehearse();

    mutable Logger rtclog;
    coil::Properties m_properties;
    std::chrono::nanoseconds m_phase{0};
    ExecutionKind m_kind = PERIODIC;

  private:
    using Participant = std::shared_ptr<RTC_impl::RTObjectStateMachine>;
    Participant find(LightweightRTObject_ptr comp);
    // The list is replaced, never changed. Therefore a cycle uses it without a copy and without the mutex.
    using Participants = std::shared_ptr<const std::vector<Participant>>;
    Participants participants() const;
    void addParticipant(Participant participant);
    /// Whether a thread that requests a transition waits for its end, and for how long.
    struct TransitionWait {
        bool sync = true;
        std::chrono::nanoseconds timeout = std::chrono::milliseconds(500);
    };
    ReturnCode_t requestTransition(LightweightRTObject_ptr comp, LifeCycleState from, LifeCycleState to,
                                   const TransitionWait& wait);
    ReturnCode_t waitForTransition(const Participant& participant, LifeCycleState to,
                                   std::chrono::nanoseconds timeout);
    struct CycleResult {
        bool changed_state = false, has_work = false;
    };
    CycleResult cycle();
    /// Returns false if the value has not changed.
    bool setRunning(bool running);
    void forEach(ReturnCode_t (RTC_impl::RTObjectStateMachine::*call)());

    // First what each cycle uses.
    mutable std::mutex m_mutex; // guards participants, rate, running
    Participants m_participants = std::make_shared<const std::vector<Participant>>();
    std::timed_mutex m_cycleMutex;                                 // held during a cycle
    std::atomic<std::thread::id> m_cycleThread{std::thread::id()}; // the thread inside a cycle, if any

    // Held during start() and stop(); locked before m_mutex. Recursive, because a callback of start() may call
    // stop().
    std::recursive_timed_mutex m_startStopMutex;
    bool m_running = false;
    double m_rate = DEFAULT_EXECUTION_RATE;
    TransitionWait m_activation, m_deactivation, m_reset;
    RTObject_var m_owner;
    ExecutionContextService_var m_objref;
    std::mutex m_cycleDoneMutex;
    std::condition_variable m_cycleDone; // notified after each cycle with a transition
};

/// Context types from libraries, by name. Manager::registerECFactory() is the 1.x way to add one.
using ExecutionContextFactory = coil::GlobalFactory<ExecutionContextBase>;
using ECNewFunc = ExecutionContextBase* (*)();
using ECDeleteFunc = void (*)(ExecutionContextBase*);

/// Functions for registerECFactory().
template <class T_New>
ExecutionContextBase* ECCreate() {
    return new T_New();
}
/// Releases the creator's reference. A running call from outside keeps the context until the call ends.
void deleteExecutionContext(ExecutionContextBase* context);
template <class T_Delete>
void ECDelete(ExecutionContextBase* context) {
    deleteExecutionContext(context);
}

/// The CORBA object of a context. `Skeleton` is one of the POA_ classes of execution contexts. Each IDL operation
/// calls its counterpart above. [ORB threads]
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
