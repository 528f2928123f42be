// SPDX-License-Identifier: Apache-2.0
// State machines of components: Macho's machines, with states that have onEntry(), onInit() and onExit(). The
// component's FSM listeners are called before and after them.
#ifndef RTC_STATICFSM_H
#define RTC_STATICFSM_H
#include <deque>
#include <functional>
#include <mutex>
#include <rtm/Macho.h>
#include <rtm/RTObject.h>

#define FSM_TOPSTATE(TOP) struct TOP : public ::RTC::Link<TOP, ::Macho::TopBase<TOP>>
#define FSM_SUBSTATE(STATE, SUPERSTATE) struct STATE : public ::RTC::Link<STATE, SUPERSTATE>
#define FSM_STATE(S) TANDEM_MACHO_STATE(S, TANDEM_MACHO_SINGLE(::RTC::Link<S, SUPER>))
/// In OpenRTM-aist, a source file uses it once for each state to define the state's data. Not needed here.
#define FSM_INIT_VALUE(S) static_assert(sizeof(S) > 0, "FSM_INIT_VALUE: not a state");

namespace RTC {

/// The queue of events that ports have received and the machine has not handled yet. [any-thread]
class FsmEvents {
  public:
    /// Reads the properties `length` (8) and `write.full_policy` (overwrite | do_nothing; overwrite) of `buffer`.
    void init(const coil::Properties& buffer);
    /// Appends the event. Returns false if the queue is full and the event is dropped.
    bool put(std::function<void()> event);
    /// Takes the oldest event. Returns false if there is none.
    bool take(std::function<void()>& event);
    std::size_t readable() const;

  private:
    mutable std::mutex m_mutex;
    std::deque<std::function<void()>> m_events;
    std::size_t m_length = 8;
    bool m_overwrite = true;
};

/// A component's state machine. Ports put events into it; run_event() (in onExecute) handles them.
template <class TOP>
class Machine : public Macho::Machine<TOP> {
  public:
    explicit Machine(RTObject_impl* comp) : rtComponent(comp) {}
    FsmEvents& getBuffer() { return m_events; }
    /// Handles the events that are now in the queue. Later events wait for the next call.
    virtual void run_event() {
        std::function<void()> event;
        for (std::size_t n = m_events.readable(); n > 0 && m_events.take(event); --n) event();
    }

  private:
    template <class C, class P>
    friend class Link;
    RTObject_impl* rtComponent;
    FsmEvents m_events;
};

/// A state. During construction of the machine, its listeners cannot be called, because the component is not known
/// yet.
template <class C, class P>
class Link : public Macho::Link<C, P> {
  protected:
    explicit Link(Macho::_StateInstance& instance) : Macho::Link<C, P>(instance) {}

    void setrtc() {
        if (rtComponent != nullptr) return;
        if (auto* machine = dynamic_cast<const RTC::Machine<typename P::TOP>*>(&this->machine()))
            rtComponent = machine->rtComponent;
    }

  public:
    using LINK = Link<C, P>;

    void entry() override {
        setrtc();
        if (rtComponent == nullptr) {
            onEntry();
            return;
        }
        rtComponent->postOnFsmStateChange(C::_state_name(), RTC_OK);
        rtComponent->preOnFsmEntry(C::_state_name());
        rtComponent->postOnFsmEntry(C::_state_name(), onEntry());
    }
    void init() override {
        setrtc();
        if (rtComponent == nullptr) {
            onInit();
            return;
        }
        rtComponent->preOnFsmInit(C::_state_name());
        rtComponent->postOnFsmInit(C::_state_name(), onInit());
    }
    void exit() override {
        setrtc();
        if (rtComponent == nullptr) {
            onExit();
            return;
        }
        rtComponent->preOnFsmExit(C::_state_name());
        rtComponent->postOnFsmExit(C::_state_name(), onExit());
        rtComponent->preOnFsmStateChange(C::_state_name());
    }

    // Not marked override, although substates override them: the top state has no state above it.
#pragma GCC diagnostic push
#ifdef __clang__
#pragma GCC diagnostic ignored "-Winconsistent-missing-override"
#else
#pragma GCC diagnostic ignored "-Wsuggest-override"
#endif
    virtual ReturnCode_t onEntry() { return RTC_OK; }
    virtual ReturnCode_t onInit() { return RTC_OK; }
    virtual ReturnCode_t onExit() { return RTC_OK; }
#pragma GCC diagnostic pop

    RTObject_impl* rtComponent = nullptr;
};

} // namespace RTC
#endif
