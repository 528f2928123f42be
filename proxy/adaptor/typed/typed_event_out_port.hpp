// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/process/log_throttle.hpp"
#include "proxy/adaptor/archive/refusal_record.hpp"
#include "proxy/adaptor/engine/arrival_listener.hpp"
#include "proxy/adaptor/typed/typed_connections.hpp"
#include "proxy/adaptor/typed/value_type.hpp"
#include "proxy/link/channel/channel.hpp"
#include "proxy/link/protocol/port_table.hpp"

#include <OutputEventPortInterface.h>

#include <memory>
#include <string>

namespace tandem::adaptor {

/// Mirrors an output data port of the peer as an event port, for an engine with only the public API. Each message becomes
/// an event for all connected ports, in the link's notifier thread. All connected ports have the same type.
class TypedEventOutPort final : public OutputEventPortInterface,
                                public RefusalRecord,
                                private engine::ArrivalListener {
  public:
    using SetListener = TypedConnections<IEventPortLink>::SetListener;

    /// `peer` is the port's entry in the peer's table. The channel must outlive this port.
    TypedEventOutPort(link::Port peer, link::ChannelReader& channel, SetListener set_listener)
        : peer_(std::move(peer)), channel_(channel), connections_(*this, std::move(set_listener)) {}
    ~TypedEventOutPort() override { clearConnection(); }

    // Events come only from the link.
    ReturnType push(Event*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType pushEvent(unsigned char*, int) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType marshal(Event*, std::string&) override { return OPROS_UNSUPPORTED_METHOD; }

    /// Called when the engine connects this port. Asks the target for an event of its type, and compares it with the peer's
    /// signature. If they do not match, logs a line and returns false.
    bool checkType(EventPort* target) override;
    bool checkType(Event* event) override;

    void addConnection(IEventPortLink* connection) override {
        OutputEventPortInterface::addConnection(connection);
        connections_.add(connection);
    }
    void removeConnection(IEventPortLink* connection) override {
        connections_.remove(connection);
        OutputEventPortInterface::removeConnection(connection);
    }
    void clearConnection() override {
        connections_.clear();
        OutputEventPortInterface::clearConnection();
    }

  private:
    void arrived() override;
    bool read_next();
    bool decode(const shm::Record& record);

    const link::Port peer_;
    link::ChannelReader& channel_;
    TypedConnections<IEventPortLink> connections_; ///< their type is that of the contents
    // Used by the notifier thread; set before it runs here.
    opros_any content_;
    std::unique_ptr<Event> event_;
    process::LogThrottle undecodable_;
};

} // namespace tandem::adaptor
