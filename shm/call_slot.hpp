// SPDX-License-Identifier: Apache-2.0
// Inside of the call queue: both ends move a slot from state to state by these.
#pragma once
#include "shm/layout.hpp"

namespace tandem::shm {

constexpr std::uint32_t slot_word(layout::SlotState state) { return static_cast<std::uint32_t>(state); }

inline bool change_slot(layout::CallSlot& slot, layout::SlotState from, layout::SlotState to) {
    std::uint32_t expected = slot_word(from);
    return slot.state.compare_exchange_strong(expected, slot_word(to), std::memory_order_acq_rel);
}

} // namespace tandem::shm
