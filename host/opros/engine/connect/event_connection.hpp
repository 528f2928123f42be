// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/connect/connection.hpp"
#include "host/opros/engine/execute/component_host.hpp"
#include "host/opros/engine/execute/worker.hpp"

#include <InputEventPortInterface.h>
#include <OutputEventPortInterface.h>

namespace tandem::engine {

/// From one output event port to one input event port: each event is copied and delivered by the receiver's
/// worker, in order. When that has too many to deliver the newest are lost (OPROS_OUT_OF_RESOURCES).
class EventConnection : public Connection, public IEventPortLink {
  public:
    EventConnection(OutputEventPortInterface& source, InputEventPortInterface& destination,
                    ComponentHost& receiver, Worker& worker);
    ~EventConnection() override { source_.removeConnection(this); }

    ReturnType push(Event* data) override;
    ReturnType setSource(EventPort*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType addDestination(EventPort*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType removeDestination(EventPort*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType addDestination(RemoteEventPort*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType removeDestination(RemoteEventPort*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType clearDestination() override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType clearSource() override { return OPROS_UNSUPPORTED_METHOD; }

  private:
    OutputEventPortInterface& source_;
    InputEventPortInterface& destination_;
    ComponentHost& receiver_;
    Worker& worker_;
    std::atomic<bool> overflow_reported_{false};
};

} // namespace tandem::engine
