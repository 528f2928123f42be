// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OPRoSTypes.h>

#include <cstddef>
#include <vector>

namespace opros {

/// The queue of an input data port: a ring of values under one of the four policies of OPRoS. The slots keep the
/// storage of the values that were in them, so that storing a value of the usual size allocates nothing once
/// each slot has been used. Not thread-safe: the port has the lock.
class DataQueue {
  public:
    /// `limit`: values that a FIFO holds, and with which the growing policies begin; 0 counts as 1. LAST has
    /// one slot, whatever the limit.
    DataQueue(DataPortPolicy policy, std::size_t limit);

    std::size_t size() const { return count_; }
    /// Whether values leave in the order in which they were stored.
    bool keeps_order() const { return policy_ == OPROS_FIFO || policy_ == OPROS_UFIFO; }
    /// How many values it holds before the oldest gives way; 0: it grows.
    std::size_t depth() const { return policy_ == OPROS_FIFO || policy_ == OPROS_LAST ? slots_.size() : 0; }
    /// Makes room as the policy says, and returns the slot of the newest value for the caller to assign. It
    /// still holds the value that was in it before.
    opros_any& push();
    /// The value that the consumer gets next; there must be one.
    opros_any& front() { return slots_[next_index()]; }
    /// Removes front(), but leaves its storage in the slot.
    void pop();
    void clear() { count_ = 0; }

  private:
    // i <= slots_.size(). Without a division, which would take longer than all else in push().
    std::size_t index(std::size_t i) const {
        const std::size_t sum = first_ + i;
        return sum < slots_.size() ? sum : sum - slots_.size();
    }
    std::size_t next_index() const { return policy_ == OPROS_LIFO ? index(count_ - 1) : first_; }
    void grow();

    DataPortPolicy policy_;
    std::vector<opros_any> slots_;
    std::size_t first_ = 0, count_ = 0; // slot of the oldest value; values in the queue
};

} // namespace opros
