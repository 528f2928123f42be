// SPDX-License-Identifier: Apache-2.0
#include "host/opros/runtime/port/data_queue.hpp"

#include <algorithm>

namespace opros {

DataQueue::DataQueue(DataPortPolicy policy, std::size_t limit)
    : policy_(policy), slots_(policy == OPROS_LAST ? 1 : std::max<std::size_t>(limit, 1)) {}

// Swaps the values instead of copying them, so that they keep their storage.
void DataQueue::grow() {
    std::vector<opros_any> larger(slots_.size() * 2);
    for (std::size_t i = 0; i < count_; ++i) larger[i].swap(slots_[index(i)]);
    slots_.swap(larger);
    first_ = 0;
}

opros_any& DataQueue::push() {
    if (count_ == slots_.size()) {
        // FIFO and LAST drop the oldest value. The other policies must keep every value.
        if (depth() != 0)
            pop();
        else
            grow();
    }
    return slots_[index(count_++)];
}

opros_any& DataQueue::push_from(DataPortSource* source) {
    if (depth() <= 1) return push(); // drops nothing, or only values that no consumer needs
    sources_.resize(slots_.size());
    if (DataPortSource* const oldest = sources_[first_]; is_full() && oldest) oldest->discarded();
    opros_any& slot = push();
    sources_[static_cast<std::size_t>(&slot - slots_.data())] = source;
    return slot;
}

void DataQueue::forget(DataPortSource* source) {
    std::replace(sources_.begin(), sources_.end(), source, static_cast<DataPortSource*>(nullptr));
}

void DataQueue::pop() {
    // A stack drops its newest value, which is in the last used slot. Decrementing the count is enough.
    if (policy_ != OPROS_LIFO) first_ = index(1);
    --count_;
}

} // namespace opros
