// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/connect/event_connection.hpp"

#include <spdlog/spdlog.h>

namespace tandem::engine {

EventConnection::EventConnection(OutputEventPortInterface& source, InputEventPortInterface& destination,
                                 ComponentHost& receiver, Worker& worker)
    : source_(source), destination_(destination), receiver_(receiver), worker_(worker) {
    source_.addConnection(this);
}

ReturnType EventConnection::push(Event* data) {
    const std::shared_ptr<Event> copy(data->clone());
    const bool taken = worker_.submit([copy, &port = destination_, &receiver = receiver_] {
        const LifecycleState state = receiver.component().getStatus();
        if (state == OPROS_CS_ERROR || state == OPROS_CS_DESTROYED) return;
        receiver.run_guarded("onEvent", [&] { port.push(copy.get()); });
        receiver.input_signal().arrived();
    });
    if (taken) return OPROS_SUCCESS;
    if (!overflow_reported_.exchange(true))
        spdlog::warn("component {}: events come faster than onEvent takes them, some are lost",
                     receiver_.name());
    return OPROS_OUT_OF_RESOURCES;
}

} // namespace tandem::engine
