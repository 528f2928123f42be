// SPDX-License-Identifier: Apache-2.0
#include "host/opros/runtime/port/data_queue.hpp"

#include <InputDataPortInterface.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>

namespace {
// A source is asked no more often than this in one poll, so that a poll ends whatever the other side does.
constexpr int values_per_poll = 4096;
} // namespace

class InputDataPortImpl {
  public:
    InputDataPortImpl(InputDataPortInterface& port, DataPortPolicy policy, unsigned int limit)
        : port_(port), queue_(policy, limit) {}

    void push(const opros_any& value) {
        put(value);
        if (DataPortListener* listener = listener_.load(std::memory_order_acquire)) listener->arrived();
    }

    opros_any* pop() {
        if (idle()) return nullptr;
        const std::lock_guard<std::mutex> lock(mutex_);
        if (queue_.size() == 0 && caught_up_ && queue_.keeps_order()) return next_of_sources();
        poll_sources();
        caught_up_ = queue_.size() == 0;
        if (caught_up_) return prepare();
        opros_any* value = hand_out(queue_.front());
        queue_.pop();
        note();
        return value;
    }

    opros_any* peek() {
        if (idle()) return nullptr;
        const std::lock_guard<std::mutex> lock(mutex_);
        poll_sources();
        return queue_.size() == 0 ? nullptr : new opros_any(queue_.front());
    }

    std::size_t size() {
        if (idle()) return 0;
        const std::lock_guard<std::mutex> lock(mutex_);
        poll_sources();
        return queue_.size();
    }

    void clear() {
        const std::lock_guard<std::mutex> lock(mutex_);
        for (DataPortSource* source : sources_)
            for (int i = 0; i < values_per_poll && source->next(); ++i) source->done();
        queue_.clear();
        note();
    }

    void add(DataPortSource* source) {
        const std::lock_guard<std::mutex> lock(mutex_);
        sources_.push_back(source);
        sourced_ = true;
        note();
    }

    void remove(DataPortSource* source) {
        const std::lock_guard<std::mutex> lock(mutex_);
        sources_.erase(std::remove(sources_.begin(), sources_.end(), source), sources_.end());
        sourced_ = !sources_.empty();
        note();
    }

    void listen(DataPortListener* listener) { listener_.store(listener, std::memory_order_release); }
    bool has_sources() const { return sourced_.load(std::memory_order_acquire); }

    bool take_default_queue(DataPortPolicy policy, unsigned int limit) {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (!by_default_) return false;
        queue_ = opros::DataQueue(policy, limit);
        note();
        return true;
    }
    void chosen_by_default() { by_default_ = true; }

  private:
    enum class Read { nothing, undecodable, value };

    void put(const opros_any& value) {
        const std::lock_guard<std::mutex> lock(mutex_);
        // Copied into a value of this port's own making: that of the source may belong to a library that goes
        // first.
        opros_any& slot = queue_.push();
        if (slot.empty()) slot = port_.sample();
        slot = value;
        note();
    }

    /// A consumer that polls must not get into the way of those who push: nothing to take is seen without the
    /// lock.
    bool idle() const { return !worth_a_look_.load(std::memory_order_acquire); }
    void note() { worth_a_look_.store(queue_.size() != 0 || !sources_.empty(), std::memory_order_release); }

    void poll_sources() {
        for (DataPortSource* source : sources_)
            for (int i = 0; i < values_per_poll && !queue_.full(); ++i) {
                const Read read = read_one(*source);
                if (read == Read::nothing) break;
                if (read == Read::value) queue_.push().swap(scratch_); // its storage goes round
            }
    }

    /// For a consumer that found nothing the last time, and so waits for the next value: it gets that one at
    /// once, without a second look at a source that is most likely empty then (in shared memory, such a look
    /// costs as much as the value's own way). What else waits there comes into the queue with the next pop().
    opros_any* next_of_sources() {
        for (DataPortSource* source : sources_)
            for (int i = 0; i < values_per_poll; ++i) {
                const Read read = read_one(*source);
                if (read == Read::nothing) break;
                if (read == Read::undecodable) continue;
                caught_up_ = false;
                return hand_out(scratch_);
            }
        return prepare();
    }

    /// While there is nothing to do: makes the next value to be handed out, with as much storage as the last
    /// one had. Not of a large one: that would be a copy, and would cost more than it saves.
    opros_any* prepare() {
        if (!spare_ && !scratch_.empty() && !large_) spare_ = std::make_unique<opros_any>(scratch_);
        return nullptr;
    }

    opros_any* hand_out(opros_any& value) {
        if (!spare_ && !large_) return new opros_any(value);
        if (!spare_) spare_ = std::make_unique<opros_any>();
        spare_->swap(value); // and its storage takes the place of what leaves
        return spare_.release();
    }

    Read read_one(DataPortSource& source) {
        opros::archive::iarchive* archive = source.next();
        if (!archive) return Read::nothing;
        Read read = Read::undecodable;
        try {
            if (scratch_.empty()) scratch_ = port_.sample();
            scratch_.decode(*archive);
            read = Read::value;
        } catch (const std::exception& error) {
            source.undecodable(error.what());
        } catch (...) { // users' load() functions throw what they like; the source must get its done() all
                        // the same
            source.undecodable("an exception of unknown type");
        }
        large_ = source.large();
        source.done();
        return read;
    }

    InputDataPortInterface& port_;
    std::mutex mutex_;
    opros::DataQueue queue_;
    opros_any scratch_; // decoded here first: a value that breaks off half-way must cost no older one
    std::vector<DataPortSource*> sources_;
    std::unique_ptr<opros_any> spare_; // the next to be handed out
    bool caught_up_ = false;           // the last pop() found nothing
    bool large_ = false;               // the last value of a source was
    bool by_default_ = false;          // the component's code has left the queue to the profile
    std::atomic<bool> worth_a_look_{false}, sourced_{false};
    std::atomic<DataPortListener*> listener_{nullptr};
};

InputDataPortInterface::InputDataPortInterface() : InputDataPortInterface("") {}
InputDataPortInterface::InputDataPortInterface(DataPortPolicy data_policy, unsigned int queue_limit)
    : InputDataPortInterface("", data_policy, queue_limit) {}
InputDataPortInterface::InputDataPortInterface(const std::string& name)
    : InputDataPortInterface(name, OPROS_FIFO, DEFAULT_QUEUE_LIMIT) {
    m_impl->chosen_by_default();
}
InputDataPortInterface::InputDataPortInterface(const std::string& name, DataPortPolicy data_policy,
                                               unsigned int queue_limit)
    : DataPort(name), m_impl(new InputDataPortImpl(*this, data_policy, queue_limit)), m_arc(nullptr) {}
InputDataPortInterface::~InputDataPortInterface() { delete m_impl; }

DataPortRole InputDataPortInterface::getRole() { return OPROS_DATA_PORT_INPUT; }
opros_any* InputDataPortInterface::peek() { return m_impl->peek(); }
opros_any* InputDataPortInterface::pop() { return m_impl->pop(); }
int InputDataPortInterface::getSize() { return static_cast<int>(m_impl->size()); }
void InputDataPortInterface::setArchiveFactory(ArchiveFactory* darc) { m_arc = darc; }
void InputDataPortInterface::reset() { m_impl->clear(); }

ReturnType InputDataPortInterface::addSource(DataPortSource* source) {
    if (!source) return OPROS_BAD_INPUT_PARAMETER;
    if (!sample().serializable()) return OPROS_UNSUPPORTED_METHOD;
    m_impl->add(source);
    return OPROS_SUCCESS;
}

ReturnType InputDataPortInterface::removeSource(DataPortSource* source) {
    m_impl->remove(source);
    return OPROS_SUCCESS;
}

bool InputDataPortInterface::hasSources() const { return m_impl->has_sources(); }
void InputDataPortInterface::setListener(DataPortListener* listener) { m_impl->listen(listener); }

ReturnType InputDataPortInterface::setQueue(DataPortPolicy policy, unsigned int limit) {
    return m_impl->take_default_queue(policy, limit) ? OPROS_SUCCESS : OPROS_PRECONDITION_NOT_MET;
}

ReturnType InputDataPortInterface::push_data(opros_any& data) {
    if (!checkType(data)) return OPROS_BAD_INPUT_PARAMETER;
    m_impl->push(data);
    return OPROS_SUCCESS;
}
