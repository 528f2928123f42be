// SPDX-License-Identifier: Apache-2.0
// Hierarchical state machines with the interface of Macho (E. Hiti): states are classes, a substate derives from its
// superstate, events are the virtual functions of the top state.
//
// TOPSTATE(Top) { struct Box { int n = 0; }; STATE(Top); virtual void go() {} }; SUBSTATE(Moving, Top) {
// STATE(Moving); void go() override; }; Macho::Machine<Top> m;  m->go();
//
// A handler's setState() takes effect after the handler has returned. Use a machine in one thread at a time.
#ifndef MACHO_HPP
#define MACHO_HPP
#include <cstddef>
#include <exception>
#include <rtm/MachoBase.h>
#include <tuple>
#include <type_traits>

#define TOPSTATE(TOP) struct TOP : public ::Macho::Link<TOP, ::Macho::TopBase<TOP>>
#define SUBSTATE(STATE, SUPERSTATE) struct STATE : public ::Macho::Link<STATE, SUPERSTATE>

#define TANDEM_MACHO_STATE(S, Base)                                                                          \
  public:                                                                                                    \
    using SELF = S;                                                                                          \
    explicit S(::Macho::_StateInstance& instance) : Base(instance) {}                                        \
    ~S() override {}                                                                                         \
    static const char* _state_name() { return #S; }                                                          \
    Box& box() { return *static_cast<Box*>(this->_box()); }                                                  \
    friend class ::_VS8_Bug_101615
#define TANDEM_MACHO_SINGLE(...) __VA_ARGS__
#define STATE(S) TANDEM_MACHO_STATE(S, TANDEM_MACHO_SINGLE(::Macho::Link<S, SUPER>))

/// setStateHistory<S>() returns to the direct substate of S that was left last.
#define HISTORY()                                                                                            \
  public:                                                                                                    \
    ::Macho::_History _history() const override { return ::Macho::_History::shallow; }
/// setStateHistory<S>() returns to the innermost substate of S that was left last.
#define DEEPHISTORY()                                                                                        \
  public:                                                                                                    \
    ::Macho::_History _history() const override { return ::Macho::_History::deep; }
/// Keeps the state's Box while the machine is in other states.
#define PERSISTENT()                                                                                         \
  public:                                                                                                    \
    bool _persistent() const override { return true; }

/// Calls the init() of a state, which may be private. (It is a friend of each state, with Macho's name.)
class _VS8_Bug_101615 {
  public:
    template <class S, class... A, std::size_t... I>
    static void initialize(S& state, const std::tuple<A...>& arguments, std::index_sequence<I...>) {
        state.init(std::get<I>(arguments)...);
    }
};

namespace Macho {

template <class TOP>
class Machine;

/// An event as an object: dispatch() calls its handler in the state that is then current.
template <class TOP>
class IEvent {
  public:
    virtual ~IEvent() = default;
    virtual void dispatch(TOP& state) = 0;
};

template <class TOP, class R, class... P>
class _Event : public IEvent<TOP> {
  public:
    template <class... A>
    explicit _Event(R (TOP::*handler)(P...), A&&... arguments)
        : m_handler(handler), m_arguments(std::forward<A>(arguments)...) {}
    void dispatch(TOP& state) override { call(state, std::index_sequence_for<P...>()); }

  private:
    template <std::size_t... I>
    void call(TOP& state, std::index_sequence<I...>) {
        (state.*m_handler)(std::get<I>(m_arguments)...);
    }
    R (TOP::*m_handler)(P...);
    std::tuple<std::decay_t<P>...> m_arguments;
};

/// Returns an event for dispatch(), which deletes it: `dispatch(Macho::Event(&Top::go, 3))`.
template <class TOP, class R, class... P, class... A>
IEvent<TOP>* Event(R (TOP::*handler)(P...), A&&... arguments) {
    return new _Event<TOP, R, P...>(handler, std::forward<A>(arguments)...);
}

/// The superstate of the top state.
template <class T>
class TopBase : public _StateSpecification {
  public:
    using TOP = T;
    explicit TopBase(_StateInstance& instance) : _StateSpecification(instance) {}
    /// For states: dispatches an event after the current handler, to the machine's state at that time.
    void dispatch(IEvent<TOP>* event) { owner()._setPendingEvent(event); }
    const Machine<TOP>& machine() { return owner(); }

  private:
    Machine<TOP>& owner() { return static_cast<Machine<TOP>&>(this->_machine()); }
};

/// State C with the superstate P.
template <class C, class P>
class Link : public P {
  public:
    using SUPER = P;
    using TOP = typename P::TOP;
    using LINK = Link<C, P>;
    using Box = _EmptyBox;

    // Overridden with empty functions, so that a state does not inherit them: they run for the superstate itself.
    void entry() override {}
    void exit() override {}
    void init() override {}
    _History _history() const override { return _History::none; }
    bool _persistent() const override { return false; }

    static Alias alias() { return Alias(&_MachineBase::_instance<C>, C::_state_name(), typeid(C)); }
    static bool isCurrent(const _MachineBase& machine) { return machine._isIn<C>(); }
    static bool isCurrentDirect(const _MachineBase& machine) { return machine._isExactlyIn<C>(); }
    static void clearHistory(const _MachineBase& machine) { machine._forgetHistory<C>(); }

    static _StateInstance* _superInstance(_MachineBase& machine) {
        return superOf(machine, std::is_same<P, TopBase<TOP>>());
    }

  protected:
    // Each level of the class hierarchy is a state with its own Box.
    explicit Link(_StateInstance& instance) : P(superFor(instance)), m_linked(instance) {}
    void* _box() { return m_linked.box(); }

  private:
    static _StateInstance* superOf(_MachineBase&, std::true_type) { return nullptr; }
    static _StateInstance* superOf(_MachineBase& machine, std::false_type) {
        return &_MachineBase::_instance<P>(machine);
    }
    static _StateInstance& superFor(_StateInstance& instance) {
        _StateInstance* super = instance.super();
        return super != nullptr ? *super : instance;
    }

    _StateInstance& m_linked;
};

namespace _detail {
template <class S>
std::shared_ptr<void> makeBox() {
    return std::make_shared<typename S::Box>();
}
} // namespace _detail

template <class S>
_StateInstance& _MachineBase::_instance(_MachineBase& machine) {
    auto& place = machine.m_instances[typeid(S)];
    if (place == nullptr) {
        _StateInstance* super = S::LINK::_superInstance(machine);
        place.reset(new _StateInstance(machine, super, S::_state_name(), typeid(S)));
        place->m_makeBox = &_detail::makeBox<S>;
        place->m_find = &_instance<S>;
        place->m_specification.reset(new S(*place));
    }
    return *place;
}

template <class S>
Alias State() {
    return Alias(&_MachineBase::_instance<S>, S::_state_name(), typeid(S));
}
/// Names a state with arguments for S::init(...).
template <class S, class A0, class... A>
Alias State(const A0& first, const A&... others) {
    const std::tuple<A0, A...> kept(first, others...);
    return Alias(&_MachineBase::_instance<S>, S::_state_name(), typeid(S), [kept](_StateInstance& instance) {
        ::_VS8_Bug_101615::initialize(static_cast<S&>(instance.specification()), kept,
                                      std::index_sequence_for<A0, A...>());
    });
}
template <class S>
Alias StateHistory(const _MachineBase&) {
    return Alias(&_MachineBase::_instance<S>, S::_state_name(), typeid(S), nullptr, true);
}

template <class S, class... A>
void _StateSpecification::setState(const A&... arguments) {
    _machine()._setPending(State<S>(arguments...));
}
template <class S>
void _StateSpecification::setStateHistory() {
    _machine()._setPending(StateHistory<S>(_machine()));
}
inline void _StateSpecification::setState(const Alias& state) { _machine()._setPending(state); }
template <class S>
void _StateSpecification::setStateBox(typename S::Box* box) {
    std::shared_ptr<typename S::Box> owned(box != nullptr ? box : new typename S::Box);
    _machine()._setPending(State<S>(), owned);
}

/// A state machine with the top state TOP. `machine->event(...)` calls the handler of the current state.
template <class TOP>
class Machine : public _MachineBase {
  public:
    Machine() { begin(State<TOP>()); }
    explicit Machine(const Alias& state) { begin(state); }
    ~Machine() override { leave(); }

    /// Calls a handler through ->. The destructor, at the end of the expression, carries out the state change that
    /// the handler has requested.
    class AfterAdvice {
      public:
        explicit AfterAdvice(Machine& machine) : m_machine(&machine) {}
        AfterAdvice(AfterAdvice&& other) noexcept : m_machine(std::exchange(other.m_machine, nullptr)) {}
        ~AfterAdvice() noexcept(false) {
            if (m_machine != nullptr && !failing()) m_machine->settleAll();
        }
        TOP* operator->() const { return &m_machine->state(); }

      private:
        // The handler has thrown: the state changes after the next event.
        static bool failing() {
#ifdef __cpp_lib_uncaught_exceptions
            return std::uncaught_exceptions() > 0;
#else
            return std::uncaught_exception();
#endif
        }
        Machine* m_machine;
    };
    AfterAdvice operator->() { return AfterAdvice(*this); }

    void dispatch(IEvent<TOP>* event, bool destroy = true) {
        std::unique_ptr<IEvent<TOP>> owned(destroy ? event : nullptr);
        event->dispatch(state());
        settleAll();
    }
    void setState(const Alias& alias) {
        _setPending(alias);
        settleAll();
    }
    const typename TOP::Box& box() { return *static_cast<typename TOP::Box*>(_instance<TOP>(*this).box()); }
    void _setPendingEvent(IEvent<TOP>* event) { m_pendingEvent.reset(event); }

  private:
    void begin(const Alias& state) {
        start(state);
        settleAll();
    }
    TOP& state() { return static_cast<TOP&>(_current().specification()); }
    void settleAll() {
        settle([this] {
            if (m_pendingEvent == nullptr) return false;
            const std::unique_ptr<IEvent<TOP>> event(std::move(m_pendingEvent));
            event->dispatch(state());
            return true;
        });
    }
    std::unique_ptr<IEvent<TOP>> m_pendingEvent;
};

} // namespace Macho
#endif
