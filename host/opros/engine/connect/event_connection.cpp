// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/connect/event_connection.hpp"

#include "host/log/log.hpp"

namespace tandem::engine {

EventConnection::EventConnection(OutputEventPortInterface& source, InputEventPortInterface& destination,
                                 const std::string& destination_name, ComponentHost& receiver)
    : source_(source), destination_(std::make_shared<Destination>(destination, destination_name, receiver)) {
    receiver.task_queue()->start();
    source_.addConnection(this);
}

void EventConnection::Destination::push(Event& event) {
    // Checks now and not when the event was sent: the component may have failed while the event waited.
    const LifecycleState state = receiver.component().getStatus();
    if (state == OPROS_CS_ERROR || state == OPROS_CS_DESTROYED) return;
    receiver.run_guarded("onEvent", [&] {
        if (port.push(&event) == OPROS_CALLER_ERROR && !no_owner_logged.exchange(true))
            log::warn(
                "component {}: events come to port '{}' and are lost, because it has no owner; call its "
                "setOwner(this) where the port is added",
                receiver.name(), name);
    });
    receiver.input_signal().arrived();
}

ReturnType EventConnection::push(Event* data) {
    const std::shared_ptr<Event> copy(data->clone()); // shared: std::function requires a copyable object
    ComponentHost& receiver = destination_->receiver;
    const bool accepted =
        receiver.task_queue()->submit([copy, destination = destination_] { destination->push(*copy); });
    if (accepted) return OPROS_SUCCESS;
    if (!overflow_logged_.exchange(true))
        log::warn("component {}: events come faster than onEvent takes them; some are lost", receiver.name());
    return OPROS_OUT_OF_RESOURCES;
}

} // namespace tandem::engine
