// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/process/log_throttle.hpp"
#include "proxy/adaptor/archive/refusal_record.hpp"
#include "proxy/link/channel/channel.hpp"
#include "proxy/link/protocol/port_table.hpp"
#include "proxy/wire/type.hpp"

#include <DataPortListener.h>
#include <OutputEventPortInterface.h>

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>

namespace tandem::adaptor {

/// Mirrors an output data port of the peer as an event port. Each message becomes an event for all connected ports. The
/// link's notifier thread puts it into the receivers' queues.
class MirrorEventOutPort final : public OutputEventPortInterface,
                                 public RefusalRecord,
                                 private DataPortListener {
  public:
    /// Sets the listener for arrived messages; nullptr: none. On return the earlier one is not in use.
    using SetListener = std::function<void(DataPortListener*)>;

    /// `peer` is the port's entry in the peer's table. The channel must outlive this port.
    MirrorEventOutPort(link::Port peer, link::ChannelReader& channel, SetListener set_listener);

    // Events come only from the link.
    ReturnType push(Event*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType pushEvent(unsigned char*, int) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType marshal(Event*, std::string&) override { return OPROS_UNSUPPORTED_METHOD; }

    /// Called when the host connects this port. Returns whether the target's type matches the peer's signature. All targets
    /// of one port have the same type.
    bool checkType(EventPort* target) override;
    /// Called by the target with an event of its type. Later events are copies of it.
    bool checkType(Event* event) override;
    std::string typeError() const override { return type_error_; }

    // Messages are taken while a port is connected.
    void addConnection(IEventPortLink* connection) override;
    void removeConnection(IEventPortLink* connection) override;

  private:
    void arrived() override;
    void send(const shm::Record& record);

    const link::Port peer_;
    link::ChannelReader& channel_;
    const SetListener set_listener_;
    // These change only while no port is connected and no event is sent.
    opros_any content_;                  ///< a value of the content's type
    std::optional<wire::Type> pictures_; ///< a message, if picture_error() must check its content
    std::unique_ptr<Event> prototype_;   ///< an event of that type
    std::mutex mutex_;                   ///< the one below
    std::set<IEventPortLink*> connections_;
    std::string type_error_;
    shm::MessageSnapshot snapshot_; ///< of a long message that is read more than once
    process::LogThrottle undecodable_;
};

} // namespace tandem::adaptor
