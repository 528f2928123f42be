// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <DataPortSource.h>
#include <OPRoSTypes.h>

#include <cstddef>
#include <vector>

namespace opros {

/// The queue of an input data port: a ring of values with one of the four OPRoS policies. The slots keep the storage
/// of their previous values. Once each slot has been used, storing a value of the usual size allocates no memory. Not
/// thread-safe: the port has the lock.
class DataQueue {
  public:
    /// `limit` is the capacity of a FIFO and the initial capacity of the growing policies; 0 counts as 1. LAST always
    /// has one slot.
    DataQueue(DataPortPolicy policy, std::size_t limit);

    std::size_t size() const { return count_; }
    /// Returns true if values leave in the order in which they were stored.
    bool keeps_order() const { return policy_ == OPROS_FIFO || policy_ == OPROS_UFIFO; }
    /// Returns the number of values before the oldest is dropped, or 0 if the queue grows.
    std::size_t depth() const { return policy_ == OPROS_FIFO || policy_ == OPROS_LAST ? slots_.size() : 0; }
    /// Makes room according to the policy and returns the slot of the newest value, for the caller to assign. The
    /// slot still holds its previous value.
    opros_any& push();
    /// Like push(), for a value of a source. Tells the source of a value that is dropped. nullptr: of no source.
    opros_any& push_from(DataPortSource* source);
    /// Removes the source, which is about to end, from the values that came from it.
    void forget(DataPortSource* source);
    /// Returns true if the next push() drops a value, other than the only one.
    bool is_full() const { return count_ == slots_.size() && depth() > 1; }
    /// Returns the value that the consumer gets next. The queue must not be empty.
    opros_any& front() { return slots_[next_index()]; }
    /// Removes front() but leaves its storage in the slot.
    void pop();
    void clear() { count_ = 0; }

  private:
    // i <= slots_.size(). A division would take longer than the rest of push().
    std::size_t index(std::size_t i) const {
        const std::size_t sum = first_ + i;
        return sum < slots_.size() ? sum : sum - slots_.size();
    }
    std::size_t next_index() const { return policy_ == OPROS_LIFO ? index(count_ - 1) : first_; }
    void grow();

    DataPortPolicy policy_;
    std::vector<opros_any> slots_;
    std::vector<DataPortSource*> sources_; // of the values in the slots; empty until the first push_from()
    std::size_t first_ = 0, count_ = 0;    // slot of the oldest value; values in the queue
};

} // namespace opros
