// SPDX-License-Identifier: Apache-2.0
#include "host/opros/runtime/port/input_data_port_impl.hpp"
#include "host/rt/cycle_lines.hpp"
#include "host/rt/rehearsal.hpp"

InputDataPortInterface::InputDataPortInterface() : InputDataPortInterface("") {}
InputDataPortInterface::InputDataPortInterface(DataPortPolicy data_policy, unsigned int queue_limit)
    : InputDataPortInterface("", data_policy, queue_limit) {}
InputDataPortInterface::InputDataPortInterface(const std::string& name)
    : InputDataPortInterface(name, OPROS_FIFO, DEFAULT_QUEUE_LIMIT) {
    m_impl->mark_queue_as_default();
}
InputDataPortInterface::InputDataPortInterface(const std::string& name, DataPortPolicy data_policy,
                                               unsigned int queue_limit)
    : DataPort(name), m_impl(new InputDataPortImpl(*this, data_policy, queue_limit)), m_arc(nullptr) {}
InputDataPortInterface::~InputDataPortInterface() { delete m_impl; }

DataPortRole InputDataPortInterface::getRole() { return OPROS_DATA_PORT_INPUT; }
opros_any* InputDataPortInterface::peek() { return m_impl->peek(); }
opros_any* InputDataPortInterface::pop() { return m_impl->pop(); }
void InputDataPortInterface::rehearse() {
    const tandem::rt::Rehearsal rehearsal;
    tandem::rt::note_lines(this, sizeof *this);
    delete m_impl->pop();
}
std::size_t InputDataPortInterface::countWaiting() { return m_impl->count_waiting(); }
int InputDataPortInterface::getSize() { return static_cast<int>(m_impl->size()); }
void InputDataPortInterface::setArchiveFactory(ArchiveFactory* darc) { m_arc = darc; }
void InputDataPortInterface::reset() { m_impl->clear(); }

ReturnType InputDataPortInterface::addSource(DataPortSource* source) {
    if (!source) return OPROS_BAD_INPUT_PARAMETER;
    // Checked here, because otherwise decoding would fail for each value.
    if (!sample().serializable()) return OPROS_UNSUPPORTED_METHOD;
    m_impl->add_source(source);
    return OPROS_SUCCESS;
}

ReturnType InputDataPortInterface::removeSource(DataPortSource* source) {
    m_impl->remove_source(source);
    return OPROS_SUCCESS;
}

bool InputDataPortInterface::hasPolledSources() const { return m_impl->has_polled_sources(); }
void InputDataPortInterface::setListener(DataPortListener* listener) { m_impl->set_listener(listener); }

ReturnType InputDataPortInterface::setQueue(DataPortPolicy policy, unsigned int limit) {
    return m_impl->replace_default_queue(policy, limit) ? OPROS_SUCCESS : OPROS_PRECONDITION_NOT_MET;
}

ReturnType InputDataPortInterface::push_data(opros_any& data) {
    if (!checkType(data)) return OPROS_BAD_INPUT_PARAMETER;
    m_impl->push(data);
    return OPROS_SUCCESS;
}
