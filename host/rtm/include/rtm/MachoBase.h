// SPDX-License-Identifier: Apache-2.0
// The parts of Macho.h's state machines that do not depend on the state classes.
#ifndef MACHO_BASE_HPP
#define MACHO_BASE_HPP
#include <functional>
#include <map>
#include <memory>
#include <typeindex>
#include <utility>

namespace Macho {

class _MachineBase;
class _StateInstance;

enum class _History : unsigned char { none, shallow, deep };
/// The Box of states without data.
struct _EmptyBox {};

/// The base class of all states.
class _StateSpecification {
  public:
    explicit _StateSpecification(_StateInstance& instance) : m_instance(instance) {}
    virtual ~_StateSpecification() = default;
    virtual void entry() {}
    virtual void exit() {}
    virtual void init() {}
    virtual _History _history() const { return _History::none; }
    virtual bool _persistent() const { return false; }

  protected:
    // Request a state change. For handlers, entry(), exit() and init() of the current state.
    template <class S, class... A>
    void setState(const A&... arguments);
    template <class S>
    void setStateHistory();
    void setState(const class Alias& state);
    /// Requests a state change with a Box, of which it takes ownership. NULL: a new Box.
    template <class S>
    void setStateBox(typename S::Box* box = nullptr);

    _MachineBase& _machine();

  private:
    _StateInstance& m_instance;
};

/// A state within one machine: its position in the hierarchy, its Box and its history.
class _StateInstance {
  public:
    _StateInstance(_MachineBase& machine, _StateInstance* super, const char* name, std::type_index type)
        : m_machine(machine), m_super(super), m_name(name), m_type(type) {}
    _StateInstance(const _StateInstance&) = delete;
    _StateInstance& operator=(const _StateInstance&) = delete;

    _MachineBase& machine() { return m_machine; }
    _StateInstance* super() { return m_super; }
    const char* name() const { return m_name; }
    std::type_index type() const { return m_type; }
    /// Returns true if this is `other` or one of its substates.
    bool isChild(const _StateInstance& other) const {
        return this == &other || (m_super != nullptr && m_super->isChild(other));
    }
    void* box() { return m_box.get(); }

    _StateSpecification& specification() { return *m_specification; }
    std::unique_ptr<_StateSpecification> m_specification;
    std::shared_ptr<void> m_box;
    std::shared_ptr<void> (*m_makeBox)() = nullptr;
    _StateInstance& (*m_find)(_MachineBase&) = nullptr;
    _StateInstance* m_history = nullptr;

  private:
    _MachineBase& m_machine;
    _StateInstance* m_super;
    const char* m_name;
    std::type_index m_type;
};

inline _MachineBase& _StateSpecification::_machine() { return m_instance.machine(); }

/// Names a state and the action on entering it. Created by `State<S>(...)` and Machine::currentState().
class Alias {
  public:
    using Find = _StateInstance& (*)(_MachineBase&);
    using Init = std::function<void(_StateInstance&)>;
    Alias(Find find, const char* name, std::type_index type, Init init = nullptr, bool history = false)
        : m_find(find), m_name(name), m_type(type), m_init(std::move(init)), m_history(history) {}
    const char* name() const { return m_name; }
    bool operator==(const Alias& other) const { return m_type == other.m_type; }
    bool operator!=(const Alias& other) const { return !(*this == other); }

  private:
    friend class _MachineBase;
    Find m_find;
    const char* m_name;
    std::type_index m_type;
    Init m_init;
    bool m_history;
};

class _MachineBase {
  public:
    _MachineBase() = default;
    _MachineBase(const _MachineBase&) = delete;
    _MachineBase& operator=(const _MachineBase&) = delete;
    virtual ~_MachineBase() = default;

    Alias currentState() const {
        return Alias(m_current->m_find, m_current->name(), m_current->type(), nullptr, true);
    }
    template <class S>
    bool _isIn() const {
        const auto found = m_instances.find(typeid(S));
        return found != m_instances.end() && m_current->isChild(*found->second);
    }
    template <class S>
    bool _isExactlyIn() const {
        return m_current->type() == typeid(S);
    }
    template <class S>
    void _forgetHistory() const {
        const auto found = m_instances.find(typeid(S));
        if (found != m_instances.end()) found->second->m_history = nullptr;
    }
    _StateInstance& _current() { return *m_current; }

    template <class S>
    static _StateInstance& _instance(_MachineBase& machine);
    void _setPending(const Alias& state, std::shared_ptr<void> box = nullptr) {
        m_pending.reset(new Pending{state, std::move(box)});
    }

  protected:
    void start(const Alias& state);
    /// Exits all states.
    void leave();
    /// Carries out pending state changes, then dispatches a pending event, if any, and repeats.
    template <class DispatchPending>
    void settle(DispatchPending dispatch_pending) {
        do
            while (m_pending) change();
        while (dispatch_pending());
    }

  private:
    struct Pending {
        Alias state;
        std::shared_ptr<void> box;
    };
    void change();
    void exitTo(_StateInstance& target);
    void enter(_StateInstance& target, _StateInstance* previous);

    std::map<std::type_index, std::unique_ptr<_StateInstance>> m_instances;
    _StateInstance* m_current = nullptr;
    std::unique_ptr<Pending> m_pending;
};

} // namespace Macho
#endif
