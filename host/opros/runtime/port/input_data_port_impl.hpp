// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/runtime/port/data_queue.hpp"
#include "host/opros/runtime/port/value_pool.hpp"
#include "host/rt/short_mutex.hpp"

#include <InputDataPortInterface.h>

#include <atomic>
#include <mutex>
#include <optional>
#include <set>
#include <vector>

/// Implements InputDataPortInterface: one queue, filled by pushes of any thread and by sources, which are polled when
/// the consumer asks. [any-thread] all functions; one mutex guards everything except the atomics.
///
/// The consumer's path is short, because a control loop polls its ports in every cycle. An empty port without sources
/// is detected without the lock. With FIFO and UFIFO, a consumer that keeps up with its source gets the value without
/// going through the queue.
class InputDataPortImpl {
  public:
    InputDataPortImpl(InputDataPortInterface& port, DataPortPolicy policy, unsigned int limit);

    /// Stores a copy, releases the lock and calls the listener.
    void push(const opros_any& value);
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

    /// The source must exist until remove_source() has returned.
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

    // All require mutex_ to be held.
    void update_hints();
    void give_listener_to(DataPortSource* source);
    void poll_sources();
    std::optional<std::size_t> count_in_sources();
    ReadResult read_one(DataPortSource* const& source);
    opros_any* pop_after(ReadResult result);
    opros_any* pop_from_queue();
    void choose_sole_source();
    void rehearse_reading();

    InputDataPortInterface& port_;
    tandem::rt::ShortMutex mutex_;
    opros::DataQueue queue_;
    // set if there is exactly one source and the queue keeps the order
    DataPortSource* sole_source_ = nullptr;
    std::vector<DataPortSource*> sources_;
    std::set<DataPortSource*> polled_sources_; // those that do not notify the listener
    opros_any decoded_; // values are decoded here first: a broken one must not damage the queue
    opros::ValuePool pool_;
    unsigned empty_pops_ = 0; // pops that found the sources empty
    bool queue_is_default_ = false;
    // Both change with the lock held and are read without it.
    std::atomic<bool> may_have_values_{false}, has_polled_sources_{false};
    std::atomic<DataPortListener*> listener_{nullptr};
};
