// SPDX-License-Identifier: Apache-2.0
#include "host/opros/runtime/data_queue.hpp"

#include <InputDataPortInterface.h>

#include <algorithm>
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
        const std::lock_guard<std::mutex> lock(mutex_);
        // Copied into a value of this port's own making: that of the source may belong to a library that goes
        // first.
        opros_any& slot = queue_.push();
        if (slot.empty()) slot = port_.sample();
        slot = value;
    }

    opros_any* next(bool take) {
        const std::lock_guard<std::mutex> lock(mutex_);
        poll_sources();
        if (queue_.size() == 0) return nullptr;
        opros_any* value = new opros_any(queue_.front());
        if (take) queue_.pop();
        return value;
    }

    std::size_t size() {
        const std::lock_guard<std::mutex> lock(mutex_);
        poll_sources();
        return queue_.size();
    }

    void clear() {
        const std::lock_guard<std::mutex> lock(mutex_);
        for (DataPortSource* source : sources_)
            for (int i = 0; i < values_per_poll && source->next(); ++i) source->done();
        queue_.clear();
    }

    void add(DataPortSource* source) {
        const std::lock_guard<std::mutex> lock(mutex_);
        sources_.push_back(source);
    }

    void remove(DataPortSource* source) {
        const std::lock_guard<std::mutex> lock(mutex_);
        sources_.erase(std::remove(sources_.begin(), sources_.end(), source), sources_.end());
    }

  private:
    void poll_sources() {
        for (DataPortSource* source : sources_)
            for (int i = 0; i < values_per_poll && !queue_.full(); ++i)
                if (!take_one(*source)) break;
    }

    bool take_one(DataPortSource& source) {
        opros::archive::iarchive* archive = source.next();
        if (!archive) return false;
        try {
            if (scratch_.empty()) scratch_ = port_.sample();
            scratch_.decode(*archive);
            queue_.push() = scratch_;
        } catch (const std::exception& error) {
            source.undecodable(error.what());
        }
        source.done();
        return true;
    }

    InputDataPortInterface& port_;
    std::mutex mutex_;
    opros::DataQueue queue_;
    opros_any scratch_; // decoded here first: a value that breaks off half-way must cost no older one
    std::vector<DataPortSource*> sources_;
};

InputDataPortInterface::InputDataPortInterface()
    : InputDataPortInterface("", OPROS_FIFO, DEFAULT_QUEUE_LIMIT) {}
InputDataPortInterface::InputDataPortInterface(DataPortPolicy data_policy, unsigned int queue_limit)
    : InputDataPortInterface("", data_policy, queue_limit) {}
InputDataPortInterface::InputDataPortInterface(const std::string& name)
    : InputDataPortInterface(name, OPROS_FIFO, DEFAULT_QUEUE_LIMIT) {}
InputDataPortInterface::InputDataPortInterface(const std::string& name, DataPortPolicy data_policy,
                                               unsigned int queue_limit)
    : DataPort(name), m_impl(new InputDataPortImpl(*this, data_policy, queue_limit)), m_arc(nullptr) {}
InputDataPortInterface::~InputDataPortInterface() { delete m_impl; }

DataPortRole InputDataPortInterface::getRole() { return OPROS_DATA_PORT_INPUT; }
opros_any* InputDataPortInterface::peek() { return m_impl->next(false); }
opros_any* InputDataPortInterface::pop() { return m_impl->next(true); }
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

ReturnType InputDataPortInterface::push_data(opros_any& data) {
    if (!checkType(data)) return OPROS_BAD_INPUT_PARAMETER;
    m_impl->push(data);
    return OPROS_SUCCESS;
}
