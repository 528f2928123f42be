// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/process/log_throttle.hpp"
#include "proxy/adaptor/archive/refusal_record.hpp"
#include "proxy/adaptor/engine/arrival_listener.hpp"
#include "proxy/adaptor/typed/typed_connections.hpp"
#include "proxy/adaptor/typed/value_type.hpp"
#include "proxy/link/channel/channel.hpp"
#include "proxy/link/protocol/port_table.hpp"

#include <OutputDataPortInterface.h>

#include <string>

namespace tandem::adaptor {

/// Mirrors an output data port of the peer, for an engine with only the public API, whose input ports do not read. The
/// link's notifier thread pushes each message to all connected ports on arrival. All connected ports have the same type.
class TypedOutPort final : public OutputDataPortInterface,
                           public RefusalRecord,
                           private engine::ArrivalListener {
  public:
    using SetListener = TypedConnections<IDataPortLink>::SetListener;

    /// `peer` is the port's entry in the peer's table; `convert` is that of check_type(). The channel must outlive this
    /// port.
    TypedOutPort(link::Port peer, link::ChannelReader& channel, SetListener set_listener,
                 std::string convert = "");
    ~TypedOutPort() override { clearConnection(); }

    // Values come only from the link.
    ReturnType push(opros_any&) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType pushData(unsigned char*, int) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType marshal(opros_any&, std::string&) override { return OPROS_UNSUPPORTED_METHOD; }

    /// Called when the engine connects this port. Asks the target for its type, and compares it with the peer's signature.
    /// If they do not match, logs a line and returns false.
    bool checkType(DataPort* target) override;
    /// Called by the target with a value of its type.
    bool checkType(opros_any& sample) override;

    void addConnection(IDataPortLink* connection) override {
        OutputDataPortInterface::addConnection(connection);
        connections_.add(connection);
    }
    void removeConnection(IDataPortLink* connection) override {
        connections_.remove(connection);
        OutputDataPortInterface::removeConnection(connection);
    }
    void clearConnection() override {
        connections_.clear();
        OutputDataPortInterface::clearConnection();
    }

  private:
    void arrived() override;
    bool read_next();
    bool decode(const shm::Record& record);

    const link::Port peer_;
    link::ChannelReader& channel_;
    const std::string convert_;
    TypedConnections<IDataPortLink> connections_;
    TypeCheck check_;
    // Used by the notifier thread; set before it runs here.
    opros_any value_;
    wire::MessageBuffer converted_; ///< a message after its conversion; kept for its memory
    shm::MessageSnapshot snapshot_; ///< of a long message that is read more than once
    process::LogThrottle undecodable_;
};

} // namespace tandem::adaptor
