// SPDX-License-Identifier: Apache-2.0
// The queue of an input data port.
#pragma once

#include <OPRoSTypes.h>

#include <cstddef>
#include <vector>

namespace opros {

/// A ring of values. The slots keep their values' storage, so that once warm, putting values in allocates
/// nothing.
class DataQueue {
  public:
    DataQueue(DataPortPolicy policy, std::size_t limit);

    std::size_t size() const { return count_; }
    /// Whether values leave in the order in which they came, all of them while there is room.
    bool keeps_order() const { return policy_ == OPROS_FIFO || policy_ == OPROS_UFIFO; }
    /// Whether one more value would cost an older one that somebody still wants.
    bool full() const { return policy_ == OPROS_FIFO && count_ >= slots_.size(); }
    /// Makes room as the policy says and returns the slot for the newest value, to be assigned to.
    opros_any& push();
    /// The value that is next by the policy; there must be one.
    opros_any& front() { return slots_[next_index()]; }
    void pop();
    void clear() { count_ = 0; }

  private:
    std::size_t index(std::size_t i) const { return (first_ + i) % slots_.size(); }
    std::size_t next_index() const { return policy_ == OPROS_LIFO ? index(count_ - 1) : first_; }
    void grow();

    DataPortPolicy policy_;
    std::vector<opros_any> slots_;
    std::size_t first_ = 0, count_ = 0;
};

} // namespace opros
