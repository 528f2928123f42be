// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/connect/event_connection.hpp"

#include "host/log/log.hpp"

namespace tandem::engine {

EventConnection::EventConnection(OutputEventPortInterface& source, InputEventPortInterface& destination,
                                 ComponentHost& receiver)
    : source_(source), destination_(destination), receiver_(receiver) {
    receiver_.task_queue()->start();
    source_.addConnection(this);
}

ReturnType EventConnection::push(Event* data) {
    const std::shared_ptr<Event> copy(data->clone()); // shared: std::function wants what can be copied
    const bool accepted = receiver_.task_queue()->submit([copy, &port = destination_, &receiver = receiver_] {
        // Looked at here, not when the event was sent: it may have waited while the component failed.
        const LifecycleState state = receiver.component().getStatus();
        if (state == OPROS_CS_ERROR || state == OPROS_CS_DESTROYED) return;
        receiver.run_guarded("onEvent", [&] { port.push(copy.get()); });
        receiver.input_signal().arrived();
    });
    if (accepted) return OPROS_SUCCESS;
    if (!overflow_logged_.exchange(true))
        log::warn("component {}: events come faster than onEvent takes them, some are lost",
                  receiver_.name());
    return OPROS_OUT_OF_RESOURCES;
}

} // namespace tandem::engine
