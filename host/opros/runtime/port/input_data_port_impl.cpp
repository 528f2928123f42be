// SPDX-License-Identifier: Apache-2.0
#include "host/opros/runtime/port/input_data_port_impl.hpp"

#include "host/rt/crossings.hpp"
#include "host/rt/cycle_lines.hpp"
#include "host/rt/rehearsal.hpp"

#include <algorithm>
#include <typeinfo>

using tandem::rt::cells_for;
using tandem::rt::rehearsing;

namespace {

/// Maximum number of values that one poll takes from one source. It lets a poll end even if the other side writes as
/// fast as this side reads.
constexpr int max_values_per_poll = 4096;

/// A polling consumer rehearses reading the next value after each such number of empty pops.
constexpr unsigned empty_pops_per_rehearsal = 4096;

/// Returns where a value is stored. Of the elements of a vector of numbers, it has the first two lines.
tandem::rt::CellRing::Parts parts_of(opros_any& value) {
    opros_any::holder_base* const held = value.held();
    if (held == nullptr) return {}; // a port of the component may accept no value
    const auto* const elements = static_cast<const std::byte*>(held->elements().begin);
    return {&value, held, elements, elements + tandem::rt::CellRing::line};
}

} // namespace

InputDataPortImpl::InputDataPortImpl(InputDataPortInterface& port, DataPortPolicy policy, unsigned int limit)
    : port_(port), queue_(policy, limit) {
    choose_way();
}

void InputDataPortImpl::push(opros_any& value) {
    {
        if (!push_mutex_.lock_unless_rehearsing()) return;
        const tandem::rt::ShortLock lock(push_mutex_, std::adopt_lock);
        if (ring_)
            push_into_ring(value);
        else if (!rehearsing())
            push_into_queue(value);
    }
    if (rehearsing()) return;
    if (DataPortListener* listener = listener_.load(std::memory_order_acquire)) listener->arrived();
}

/// Returns whether a value has the port's type. A library may have its own type_info for it.
inline bool InputDataPortImpl::has_my_type(const opros_any::holder_base& held) {
    return &held.rtti() == type_.load(std::memory_order_relaxed) || has_equal_type(held);
}

bool InputDataPortImpl::has_equal_type(const opros_any::holder_base& held) {
    const std::type_info* type = type_.load(std::memory_order_relaxed);
    if (type == nullptr) {
        opros_any sample = port_.sample();
        type = sample.held() != nullptr ? &sample.held()->rtti() : &typeid(void);
        type_.store(type, std::memory_order_relaxed);
    }
    return held.rtti() == *type;
}

/// Gives decoded_ the port's type. It has the content of a value that the consumer has deleted, and perhaps changed before.
inline void InputDataPortImpl::prepare_decoded() {
    if (decoded_.empty() || !has_my_type(*decoded_.held())) [[unlikely]]
        decoded_ = port_.sample();
}

/// Returns the elements of a short vector of numbers of the port's type, else nothing.
inline std::optional<opros_any::holder_base::Memory> InputDataPortImpl::short_elements(opros_any& value) {
    opros_any::holder_base* const held = value.held();
    if (held == nullptr || held->elementBytes() == 0) return std::nullopt;
    if (!has_my_type(*held)) return std::nullopt;
    const auto elements = held->elements();
    return elements.bytes <= Ring::Content::max_size ? std::optional(elements) : std::nullopt;
}

inline void InputDataPortImpl::push_into_ring(opros_any& value) {
    const auto elements = short_elements(value);
    if (rehearsing()) {
        tandem::rt::note_crossings(ring_->published());
        ring_->prefetch_for_publish();
        tandem::rt::rehearsal_ring().take(); // what the last rehearsal has published
    }
    // A rehearsal pushes a short value, even if the port gets long ones.
    const bool is_long = !elements || (rehearsing() && !ring_->next().empty());
    if (is_long)
        push_long(value);
    else
        cells_for(*ring_).publish_short(elements->begin, elements->bytes);
}

// A new value gets an object that this port's code has created, and the copy is assigned to it. The given object may belong
// to a library that is unloaded before this port.
void InputDataPortImpl::push_long(const opros_any& value) {
    opros_any& next = ring_->next();
    if (next.empty()) [[unlikely]]
        next = port_.sample();
    if (rehearsing())
        for (const void* part : parts_of(next)) __builtin_prefetch(part, 1);
    next = value;
    if (!rehearsing()) ring_->publish(parts_of(next));
}

void InputDataPortImpl::push_into_queue(const opros_any& value) {
    const tandem::rt::ShortLock lock(mutex_);
    const bool has_sources = !sources_.empty();
    if (has_sources) [[unlikely]]
        poll_sources(); // values that wait there are older
    opros_any& slot = has_sources ? queue_.push_from(nullptr) : queue_.push();
    if (slot.empty()) slot = port_.sample();
    slot = value;
    update_hints();
}

// Takes a reference to the pointer, which is needed again only after an exception.
inline InputDataPortImpl::ReadResult InputDataPortImpl::read_one(DataPortSource* const& source) {
    try {
        prepare_decoded();
        const bool found = rehearsing() ? source->again(decoded_) : source->take(&decoded_);
        return found ? ReadResult::value : ReadResult::no_value;
    } catch (const std::exception& error) {
        if (rehearsing()) return ReadResult::no_value;
        source->undecodable(error.what());
    } catch (...) {
        // A user's load() may throw any type.
        if (rehearsing()) return ReadResult::no_value;
        source->undecodable("an exception of unknown type");
    }
    return ReadResult::undecodable;
}

opros_any* InputDataPortImpl::pop() {
    if (!may_have_values_.load(std::memory_order_acquire)) return nullptr;
    if (!mutex_.lock_unless_rehearsing()) return nullptr;
    const tandem::rt::ShortLock lock(mutex_, std::adopt_lock);
    if (ring_) return pop_from_ring();
    if (!sole_source_ || queue_.size() != 0) return pop_from_queue();
    // Does not look at the source a second time, since the source is most likely empty then. In shared memory, this check costs
    // as much as reading a value.
    const ReadResult result = read_one(sole_source_);
    return result == ReadResult::value ? pool_.lend(decoded_) : pop_after(result);
}

/// Completes pop() if the sole source's first read gave no value.
opros_any* InputDataPortImpl::pop_after(ReadResult result) {
    for (int i = 1; result == ReadResult::undecodable && i < max_values_per_poll; ++i)
        result = read_one(sole_source_);
    if (result == ReadResult::value) return pool_.lend(decoded_);
    return result == ReadResult::no_value ? found_nothing() : nullptr;
}

inline opros_any* InputDataPortImpl::pop_from_ring() {
    if (rehearsing()) {
        tandem::rt::note_lines(this, line);
        tandem::rt::note_lines(&mutex_, line);
        ring_->note_lines_of_empty();
        tandem::rt::note_crossings(ring_->taken());
        ring_->prefetch_for_take();
        const Ring::Content* const last = ring_->taken_short();
        if (last == nullptr) return pool_.lend(decoded_);
        tandem::rt::rehearsal_ring().take();
        tandem::rt::rehearsal_ring().publish_short(last->bytes(), last->size());
    }
    return cells_for(*ring_).take() ? pool_.lend(taken()) : found_nothing();
}

/// Returns the value that was taken or peeked at last.
inline opros_any& InputDataPortImpl::taken() {
    const Ring::Content* const value = cells_for(*ring_).taken_short();
    if (value == nullptr) return ring_->last();
    prepare_decoded();
    opros_any::holder_base& held = *decoded_.held();
    auto elements = held.elements();
    if (elements.bytes != value->size()) elements = held.resize(value->size() / held.elementBytes());
    value->copy_to(elements.begin);
    return decoded_;
}

/// Counts a pop that found no value, and returns NULL.
opros_any* InputDataPortImpl::found_nothing() {
    if (!rehearsing() && ++empty_pops_ % empty_pops_per_rehearsal == 0) {
        const tandem::rt::Rehearsal rehearsal;
        rehearse_reading();
    }
    return nullptr;
}

opros_any* InputDataPortImpl::pop_from_queue() {
    if (rehearsing()) [[unlikely]] {
        rehearse_reading();
        return nullptr;
    }
    poll_sources();
    if (queue_.size() == 0) return nullptr;
    opros_any* value = pool_.lend(queue_.front());
    queue_.pop();
    update_hints();
    return value;
}

opros_any* InputDataPortImpl::peek() {
    if (!may_have_values_.load(std::memory_order_acquire)) return nullptr;
    const std::lock_guard lock(mutex_);
    if (ring_) return ring_->peek() ? new opros_any(taken()) : nullptr;
    poll_sources();
    return queue_.size() == 0 ? nullptr : new opros_any(queue_.front());
}

std::size_t InputDataPortImpl::size() {
    if (!may_have_values_.load(std::memory_order_acquire)) return 0;
    const std::lock_guard lock(mutex_);
    if (ring_) return ring_->size();
    poll_sources();
    return queue_.size();
}

/// Returns nothing if some source cannot count its values.
inline std::optional<std::size_t> InputDataPortImpl::count_in_sources() {
    std::size_t sum = 0;
    for (DataPortSource* source : sources_) {
        const long waiting = source->waiting();
        if (waiting < 0) return std::nullopt;
        sum += static_cast<std::size_t>(waiting);
    }
    return sum;
}

// A value that goes through the queue takes longer, because an empty source is checked before and after it. Therefore
// a single waiting value, the usual case, stays in its source. If several values wait, the queue's policy decides
// which to keep.
std::size_t InputDataPortImpl::count_waiting() {
    if (!may_have_values_.load(std::memory_order_acquire)) return 0;
    const tandem::rt::ShortLock lock(mutex_);
    if (ring_) return ring_->size();
    if (queue_.size() == 0)
        if (const auto waiting = count_in_sources(); waiting && *waiting <= 1) [[likely]]
            return *waiting;
    poll_sources();
    // While the queue is full, the values of a sender that waits are still in the source. Without them, a component that
    // takes one value per cycle would see no difference and get no further cycle.
    const std::size_t beyond = queue_.is_full() ? count_in_sources().value_or(0) : 0;
    return queue_.size() + beyond;
}

void InputDataPortImpl::clear() {
    const std::lock_guard lock(mutex_);
    for (DataPortSource* source : sources_)
        for (int i = 0; i < max_values_per_poll && source->take(nullptr); ++i) continue;
    if (ring_)
        for (std::size_t i = 0; i < ring_->depth() && ring_->take(); ++i) continue; // another thread may push
    queue_.clear();
    update_hints();
}

void InputDataPortImpl::add_source(DataPortSource* source) {
    const std::scoped_lock lock(push_mutex_, mutex_);
    sources_.push_back(source);
    source->setDepth(queue_.depth());
    choose_way();
    give_listener_to(source);
    update_hints();
}

// The lock makes the caller wait for a poll that uses the source.
void InputDataPortImpl::remove_source(DataPortSource* source) {
    const std::scoped_lock lock(push_mutex_, mutex_);
    sources_.erase(std::remove(sources_.begin(), sources_.end(), source), sources_.end());
    if (listener_.load(std::memory_order_relaxed)) source->setListener(nullptr);
    queue_.forget(source);
    choose_way();
    polled_sources_.erase(source);
    has_polled_sources_ = !polled_sources_.empty();
    update_hints();
}

void InputDataPortImpl::set_listener(DataPortListener* listener) {
    const std::lock_guard lock(mutex_);
    listener_.store(listener, std::memory_order_release);
    for (DataPortSource* source : sources_) give_listener_to(source);
}

void InputDataPortImpl::give_listener_to(DataPortSource* source) {
    if (source->setListener(listener_.load(std::memory_order_relaxed)))
        polled_sources_.erase(source);
    else
        polled_sources_.insert(source);
    has_polled_sources_ = !polled_sources_.empty();
    // A consumer that sleeps until something arrives must wake up, because it has to poll this source from now on.
    if (DataPortListener* listener = listener_.load(std::memory_order_relaxed);
        listener && has_polled_sources_)
        listener->arrived();
}

bool InputDataPortImpl::replace_default_queue(DataPortPolicy policy, unsigned int limit) {
    const std::scoped_lock lock(push_mutex_, mutex_);
    if (!queue_is_default_) return false;
    queue_ = opros::DataQueue(policy, limit);
    for (DataPortSource* source : sources_) source->setDepth(queue_.depth());
    ring_.reset(); // it has the old depth
    choose_way();
    return true;
}

// A polling consumer must not compete for the lock with pushing threads if there is no value. Whether the ring or a source
// has a value is not known here, so a port with one of them counts as having a value.
void InputDataPortImpl::update_hints() {
    may_have_values_.store(ring_ != nullptr || queue_.size() != 0 || !sources_.empty(),
                           std::memory_order_release);
}

/// Chooses how values get from a pushing thread, or from a source, to the consumer.
void InputDataPortImpl::choose_way() {
    sole_source_ = sources_.size() == 1 && queue_.keeps_order() ? sources_.front() : nullptr;
    const std::size_t depth = queue_.depth();
    const bool can_use_ring = sources_.empty() && depth != 0 && depth <= Ring::max_depth;
    if (can_use_ring && !ring_) move_to_ring();
    if (!can_use_ring && ring_) move_to_queue();
    update_hints();
}

void InputDataPortImpl::move_to_ring() {
    ring_ = std::make_unique<Ring>(queue_.depth());
    for (; queue_.size() != 0; queue_.pop()) {
        ring_->next().swap(queue_.front());
        ring_->publish();
    }
}

void InputDataPortImpl::move_to_queue() {
    while (ring_->take()) queue_.push().swap(taken());
    ring_.reset();
}

/// Moves the waiting values of the sources into the queue, whose policy decides which values to drop. A sender that waits
/// loses none: its values stay in the source while the queue is full.
void InputDataPortImpl::poll_sources() {
    for (DataPortSource* source : sources_)
        for (int i = 0; i < max_values_per_poll; ++i) {
            if (queue_.is_full() && source->waitsForRoom()) break;
            const ReadResult result = read_one(source);
            if (result == ReadResult::no_value) break;
            // Swaps, so that the next value is decoded into the storage of an older one.
            if (result == ReadResult::value) queue_.push_from(source).swap(decoded_);
        }
}

void InputDataPortImpl::rehearse_reading() {
    if (ring_)
        delete pop_from_ring();
    else if (sources_.size() == 1 && read_one(sources_.front()) == ReadResult::value)
        delete pool_.lend(decoded_); // lends as pop() does, and deletes as the component does
}
