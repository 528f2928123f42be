// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/connect/connection.hpp"
#include "host/opros/engine/execute/component_host.hpp"

#include <InputEventPortInterface.h>
#include <OutputEventPortInterface.h>

#include <atomic>
#include <memory>
#include <string>

namespace tandem::engine {

/// Connects one output event port to one input event port. Each event is copied, and the receiver's task queue delivers
/// the copy, so a sender never waits for the receiver's onEvent(). If the queue is full, the new event is lost, and the
/// first loss is logged.
class EventConnection : public Connection, public IEventPortLink {
  public:
    /// Starts the receiver's task queue. The caller must have checked that the types match.
    EventConnection(OutputEventPortInterface& source, InputEventPortInterface& destination,
                    const std::string& destination_name, ComponentHost& receiver);
    ~EventConnection() override { disconnect(); }
    /// When this returns, no push is inside this object.
    bool disconnect() override {
        if (connected_) source_.removeConnection(this);
        return connected_ = false;
    }

    /// [any-thread] Copies the event; the caller keeps the original. Returns OPROS_OUT_OF_RESOURCES if the event is
    /// lost.
    ReturnType push(Event* data) override;
    ReturnType setSource(EventPort*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType addDestination(EventPort*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType removeDestination(EventPort*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType addDestination(RemoteEventPort*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType removeDestination(RemoteEventPort*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType clearDestination() override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType clearSource() override { return OPROS_UNSUPPORTED_METHOD; }

  private:
    /// Shared with undelivered events, which may arrive after the end of the connection.
    struct Destination {
        Destination(InputEventPortInterface& to, const std::string& its_name, ComponentHost& of)
            : port(to), name(its_name), receiver(of) {}
        void push(Event& event); ///< runs in the receiver's task queue

        InputEventPortInterface& port;
        const std::string name;
        ComponentHost& receiver;
        std::atomic<bool> no_owner_logged{false};
    };

    OutputEventPortInterface& source_;
    const std::shared_ptr<Destination> destination_;
    bool connected_ = true;
    std::atomic<bool> overflow_logged_{false};
};

} // namespace tandem::engine
