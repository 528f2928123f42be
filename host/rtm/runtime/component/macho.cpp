// SPDX-License-Identifier: Apache-2.0
// Transitions of hierarchical state machines: our own implementation of the interface of Macho (Eduard Hiti),
// on which OpenRTM-aist's StaticFSM.h is built. Leaving goes from the innermost state outwards, entering from
// the outermost inwards.
#include <rtm/MachoBase.h>
#include <vector>

namespace Macho {

// Enters `target` and its superstates, except those that `previous` has already entered.
void _MachineBase::enter(_StateInstance& target, _StateInstance* previous) {
    std::vector<_StateInstance*> path{&target};
    for (auto* super = target.super(); super != nullptr; super = super->super())
        if (previous == nullptr || !previous->isChild(*super)) path.push_back(super);
    for (std::size_t i = path.size(); i-- > 0;) {
        if (path[i]->m_box == nullptr) path[i]->m_box = path[i]->m_makeBox();
        path[i]->specification().entry();
    }
}

// Leaves the current state and its superstates up to one that contains `target`. This includes `target` itself: a
// transition to a state that is already entered leaves and re-enters it.
void _MachineBase::exitTo(_StateInstance& target) {
    _StateInstance* substate = m_current; // the substate of `left`, which was left before it
    for (auto* left = m_current; left != nullptr && (left == &target || !target.isChild(*left));
         left = left->super()) {
        left->specification().exit();
        if (left != m_current) {
            const auto kind = left->specification()._history();
            if (kind == _History::shallow) left->m_history = substate;
            if (kind == _History::deep) left->m_history = m_current;
        }
        if (!left->specification()._persistent()) left->m_box.reset();
        substate = left;
    }
}

// Carries out the pending transition. The actions of the new states may request another one, which start()
// or the dispatcher then carries out.
void _MachineBase::change() {
    const std::unique_ptr<Pending> pending(std::move(m_pending));
    _StateInstance& target = pending->state.m_find(*this);
    _StateInstance* const previous = m_current;
    if (previous != nullptr) exitTo(target);
    if (pending->box != nullptr) target.m_box = pending->box;
    m_pending.reset(); // a transition that an exit action has requested is ignored
    m_current = &target;
    enter(target, previous);
    if (pending->state.m_history && target.m_history != nullptr && target.m_history != &target) {
        _StateInstance& last = *target.m_history;
        enter(last, m_current);
        m_current = &last;
        last.specification().init();
    } else if (pending->state.m_init) {
        pending->state.m_init(target);
    } else {
        target.specification().init();
    }
}

void _MachineBase::start(const Alias& state) {
    _setPending(state);
    while (m_pending) change();
}

void _MachineBase::leave() {
    for (auto* left = m_current; left != nullptr; left = left->super()) left->specification().exit();
    m_current = nullptr;
}

} // namespace Macho
