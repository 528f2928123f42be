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

/// What an InputDataPortInterface does: one queue, filled by pushes of any thread and by sources, which are
/// polled when the consumer asks. [any-thread] all functions; one mutex guards all but the atomics.
///
/// The consumer's path is kept short, because a control loop polls its ports in every cycle: that an empty port
/// has no sources either is seen without the lock, and a consumer that keeps up with its source gets the value
/// without a stop in the queue (FIFO and UFIFO).
class InputDataPortImpl {
  public:
    InputDataPortImpl(InputDataPortInterface& port, DataPortPolicy policy, unsigned int limit);

    /// Stores a copy and calls the listener, without the lock.
    void push(const opros_any& value);
    /// The consumer gets the next value and deletes it; NULL when there is none. A warm-up gets the last value of the source
    /// once more, and takes nothing.
    opros_any* pop(bool warm_up = false);
    /// A copy of the next value, or NULL.
    opros_any* peek();
    std::size_t size();
    /// The same, but a value that waits alone stays in its source, if that can count.
    std::size_t count_waiting();
    /// Drops all values, those that wait in the sources included.
    void clear();

    /// The source must stay until remove_source() has returned.
    void add_source(DataPortSource* source);
    void remove_source(DataPortSource* source);
    /// Whether a source does not notify the listener, and so has to be polled.
    bool has_polled_sources() const { return has_polled_sources_.load(std::memory_order_acquire); }
    void set_listener(DataPortListener* listener);

    /// Before the port is in use: its constructor was given no queue.
    void mark_queue_as_default() { queue_is_default_ = true; }
    /// Replaces a queue marked so and empties the port; false otherwise.
    bool replace_default_queue(DataPortPolicy policy, unsigned int limit);

  private:
    enum class ReadResult { no_value, undecodable, value };

    // All with mutex_ held.
    void update_hints();
    void give_listener_to(DataPortSource* source);
    void poll_sources();
    std::optional<std::size_t> count_in_sources();
    ReadResult read_one(DataPortSource* const& source, bool warm_up = false);
    opros_any* pop_after(ReadResult result, bool warm_up);
    opros_any* pop_from_queue(bool warm_up);
    void choose_sole_source();
    void warm_up_reading();

    InputDataPortInterface& port_;
    tandem::rt::ShortMutex mutex_;
    opros::DataQueue queue_;
    DataPortSource* sole_source_ = nullptr; // if there is one only, and the queue keeps its order
    std::vector<DataPortSource*> sources_;
    std::set<DataPortSource*> polled_sources_; // those that do not notify the listener
    opros_any decoded_; // where a source's value is decoded: a broken one must not harm the queue
    opros::ValuePool pool_;
    unsigned empty_pops_ = 0; // of sources
    bool queue_is_default_ = false;
    // Both change with the lock held, and are read without it.
    std::atomic<bool> may_have_values_{false}, has_polled_sources_{false};
    std::atomic<DataPortListener*> listener_{nullptr};
};
