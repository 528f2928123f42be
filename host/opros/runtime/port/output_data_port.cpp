// SPDX-License-Identifier: Apache-2.0
#include "host/opros/runtime/port/connection_list.hpp"
#include "host/rt/rehearsal.hpp"

#include <OutputDataPortInterface.h>

// The public header names this class, because it cannot include opros::ConnectionList.
class OutputDataPortImpl : public opros::ConnectionList<IDataPortLink> {
  public:
    /// Pushes to all connections, one after the other. Returns the last failure.
    ReturnType push(opros_any& data) {
        ReturnType result = OPROS_SUCCESS;
        for_each([&](IDataPortLink& link) {
            if (tandem::rt::rehearsing() && !can_rehearse(link)) [[unlikely]]
                return;
            if (const ReturnType pushed = link.push(data); pushed != OPROS_SUCCESS) [[unlikely]]
                result = pushed;
        });
        return result;
    }

  private:
    static bool can_rehearse(const IDataPortLink& link) {
        const auto* rehearsable = dynamic_cast<const tandem::rt::Rehearsable*>(&link);
        return rehearsable != nullptr && rehearsable->can_rehearse();
    }
};

OutputDataPortInterface::OutputDataPortInterface() : OutputDataPortInterface("") {}
OutputDataPortInterface::OutputDataPortInterface(const std::string& name)
    : DataPort(name), m_impl(new OutputDataPortImpl), m_arc(nullptr) {}
OutputDataPortInterface::~OutputDataPortInterface() { delete m_impl; }

// An output port has no queue. Both functions belong to the interface that the two directions share.
opros_any* OutputDataPortInterface::pop() { return nullptr; }
opros_any* OutputDataPortInterface::peek() { return nullptr; }
DataPortRole OutputDataPortInterface::getRole() { return OPROS_DATA_PORT_OUTPUT; }
void OutputDataPortInterface::setArchiveFactory(ArchiveFactory* darc) { m_arc = darc; }
void OutputDataPortInterface::addConnection(IDataPortLink* connection) { m_impl->add(connection); }
void OutputDataPortInterface::removeConnection(IDataPortLink* connection) { m_impl->remove(connection); }
void OutputDataPortInterface::clearConnection() { m_impl->clear(); }

void OutputDataPortInterface::rehearse() {
    const tandem::rt::Rehearsal rehearsal;
    rehearsePush();
}

// Runs in the caller's thread.
ReturnType OutputDataPortInterface::push_data(opros_any& data) {
    if (!checkType(data)) return OPROS_BAD_INPUT_PARAMETER;
    return m_impl->push(data);
}
