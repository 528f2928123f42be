// SPDX-License-Identifier: Apache-2.0
#include <rtm/MachoBase.h>
#include <vector>

namespace Macho {

void _MachineBase::enter(_StateInstance& target, _StateInstance* previous) {
    std::vector<_StateInstance*> path{&target};
    for (auto* super = target.super(); super != nullptr; super = super->super())
        if (previous == nullptr || !previous->isChild(*super)) path.push_back(super);
    for (std::size_t i = path.size(); i-- > 0;) {
        if (path[i]->m_box == nullptr) path[i]->m_box = path[i]->m_makeBox();
        path[i]->specification().entry();
    }
}

void _MachineBase::exitTo(_StateInstance& target) {
    _StateInstance* below = m_current; // the substate of `left` that was left before it
    for (auto* left = m_current; left != nullptr && (left == &target || !target.isChild(*left));
         left = left->super()) {
        left->specification().exit();
        if (left != m_current) {
            const auto kind = left->specification()._history();
            if (kind == _History::shallow) left->m_history = below;
            if (kind == _History::deep) left->m_history = m_current;
        }
        if (!left->specification()._persistent()) left->m_box.reset();
        below = left;
    }
}

void _MachineBase::change() {
    const std::unique_ptr<Pending> wanted(std::move(m_pending));
    _StateInstance& target = wanted->state.m_find(*this);
    _StateInstance* const previous = m_current;
    if (previous != nullptr) exitTo(target);
    if (wanted->box != nullptr) target.m_box = wanted->box;
    m_pending.reset(); // a state that is left has no say in where it goes
    m_current = &target;
    enter(target, previous);
    if (wanted->state.m_history && target.m_history != nullptr && target.m_history != &target) {
        _StateInstance& last = *target.m_history;
        enter(last, m_current);
        m_current = &last;
        last.specification().init();
    } else if (wanted->state.m_init) {
        wanted->state.m_init(target);
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
