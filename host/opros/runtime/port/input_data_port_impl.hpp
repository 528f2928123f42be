// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/runtime/port/data_queue.hpp"
#include "host/opros/runtime/port/value_pool.hpp"
#include "host/rt/short_mutex.hpp"
#include "host/rt/value_ring.hpp"

#include <InputDataPortInterface.h>

#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <vector>

/// Implements InputDataPortInterface: values that are pushed by any thread, and sources, which are polled when the
/// consumer asks. [any-thread] all functions.
///
/// Pushing threads and the consumer have a mutex each, which therefore mostly has an owner. If the policy drops old values
/// (FIFO and LAST) and there are no sources, the values go through a ring, where the two do not meet. Otherwise they go
/// through the queue, and a push locks both mutexes, its own first. So does a change between ring and queue.
///
/// The consumer's path is short, because a control loop polls its ports in every cycle. With FIFO and UFIFO, a consumer that
/// keeps up with its source gets the value without going through the queue.
class InputDataPortImpl {
  public:
    InputDataPortImpl(InputDataPortInterface& port, DataPortPolicy policy, unsigned int limit);

    /// Stores a copy, releases the locks and calls the listener. In a rehearsal stores nothing.
    void push(opros_any& value);
    /// Returns the next value, which the consumer deletes, or NULL if there is none. In a rehearsal takes nothing: it
    /// returns the source's last value once more, or NULL.
    opros_any* pop();
    /// Returns a copy of the next value, or NULL.
    opros_any* peek();
    std::size_t size();
    /// Returns the number of values like size(), but leaves a single value in its source if the source can count.
    std::size_t count_waiting();
    /// Drops all values, including those that wait in the sources.
    void clear();

    /// Adds a source, which must exist until remove_source() has returned.
    void add_source(DataPortSource* source);
    void remove_source(DataPortSource* source);
    /// Returns true if a source does not notify the listener and therefore has to be polled.
    bool has_polled_sources() const { return has_polled_sources_.load(std::memory_order_acquire); }
    void set_listener(DataPortListener* listener);

    /// Notes that the constructor was given no queue. Call it before the port is in use.
    void mark_queue_as_default() { queue_is_default_ = true; }
    /// Replaces a queue marked as default and drops its values. Returns false if the queue is not marked.
    bool replace_default_queue(DataPortPolicy policy, unsigned int limit);

  private:
    enum class ReadResult { no_value, undecodable, value };
    using Ring = tandem::rt::ValueRing<opros_any>;

    bool has_my_type(const opros_any::holder_base& held);
    bool has_equal_type(const opros_any::holder_base& held);
    // Require push_mutex_ to be held.
    std::optional<opros_any::holder_base::Memory> short_elements(opros_any& value);
    void push_into_ring(opros_any& value);
    void push_long(const opros_any& value);
    void push_into_queue(const opros_any& value);
    // Require both mutexes to be held.
    void choose_way();
    void move_to_queue();
    void move_to_ring();

    // All others require mutex_ to be held.
    void update_hints();
    void give_listener_to(DataPortSource* source);
    void poll_sources();
    std::optional<std::size_t> count_in_sources();
    void prepare_decoded();
    ReadResult read_one(DataPortSource* const& source);
    opros_any* pop_after(ReadResult result);
    opros_any* pop_from_ring();
    opros_any& taken();
    opros_any* pop_from_queue();
    opros_any* found_nothing();
    void rehearse_reading();

    static constexpr std::size_t line = 64; // a pushing thread and the consumer write different cache lines

    alignas(line) InputDataPortInterface& port_;
    std::unique_ptr<Ring> ring_; // changes with both mutexes held; NULL: not used
    // These change with mutex_ held and are read without it.
    std::atomic<bool> may_have_values_{false}, has_polled_sources_{false};
    std::atomic<DataPortListener*> listener_{nullptr};
    std::atomic<const std::type_info*> type_{nullptr}; // of the port's values; NULL: not yet known

    alignas(line) tandem::rt::ShortMutex push_mutex_; // for the end of ring_ that writes

    alignas(line) tandem::rt::ShortMutex mutex_; // for all that follows, and the other end of ring_
    unsigned empty_pops_ = 0;                    // pops that found the ring or the sources empty
    opros::DataQueue queue_;
    // set if there is exactly one source and the queue keeps the order
    DataPortSource* sole_source_ = nullptr;
    std::vector<DataPortSource*> sources_;
    std::set<DataPortSource*> polled_sources_; // those that do not notify the listener
    // Values of sources and short ones of the ring are decoded here first: a broken one must not damage the queue.
    opros_any decoded_;
    opros::ValuePool pool_;
    bool queue_is_default_ = false;
};
