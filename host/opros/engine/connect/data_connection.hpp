// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/connect/connection.hpp"
#include "host/rt/rehearsal.hpp"

#include <InputDataPortInterface.h>
#include <OutputDataPortInterface.h>

namespace tandem::engine {

/// Connects one output data port to one input data port. A push at the source is a push at the destination, in the same
/// thread and without another copy. The engine makes one such object for each <port_connection>, so the functions of
/// IDataPortLink for several destinations are not supported.
class DataConnection : public Connection, public IDataPortLink, public rt::Rehearsable {
  public:
    /// The caller must have checked that the types match.
    DataConnection(OutputDataPortInterface& source, InputDataPortInterface& destination)
        : source_(source), can_rehearse_(destination.canRehearsePush() ||
                                         dynamic_cast<rt::Rehearsable*>(&destination) != nullptr),
          destination_(&destination) {
        source_.addConnection(this);
    }
    ~DataConnection() override { disconnect(); }
    /// When this returns, no push is inside this object.
    bool disconnect() override {
        if (connected_) source_.removeConnection(this);
        return connected_ = false;
    }

    /// [any-thread] Returns the result of the destination.
    ReturnType push(opros_any& data) override {
        return destination_ ? destination_->push(data) : OPROS_SUCCESS;
    }
    /// Returns false for a port whose push() the component has overridden.
    bool can_rehearse() const override { return can_rehearse_; }
    ReturnType setSource(DataPort*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType addDestination(DataPort*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType addDestination(RemoteDataPort*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType removeDestination(DataPort* dest) override {
        if (dest == destination_) destination_ = nullptr;
        return OPROS_SUCCESS;
    }
    ReturnType removeDestination(RemoteDataPort*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType clearDestination() override { return removeDestination(destination_); }
    ReturnType clearSource() override { return OPROS_UNSUPPORTED_METHOD; }

  private:
    OutputDataPortInterface& source_;
    bool connected_ = true;
    const bool can_rehearse_;
    DataPort* destination_; // NULL after removeDestination(): values are then dropped
};

} // namespace tandem::engine
