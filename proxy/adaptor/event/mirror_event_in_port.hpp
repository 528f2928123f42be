// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/channel/channel.hpp"
#include "proxy/link/protocol/port_table.hpp"

#include <InputEventPortInterface.h>

#include <string>

namespace tandem::adaptor {

/// Mirrors an input data port of the peer as an event port: the event's id and content are encoded into the link's
/// channel, in the thread that delivers events to AdaptorComp; it never blocks.
class MirrorEventInPort final : public InputEventPortInterface {
  public:
    /// `peer` is the port's entry in the peer's table. The channel must outlive this port.
    MirrorEventInPort(link::Port peer, link::ChannelWriter& channel)
        : peer_(std::move(peer)), channel_(channel) {}

    /// OPROS_OUT_OF_RESOURCES: no peer, or no room; OPROS_BAD_INPUT_PARAMETER: this event cannot be encoded. An event
    /// without content has the default value of its type.
    ReturnType push(Event* event) override;
    ReturnType push(opros::archive::iarchive&) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType pushEvent(unsigned char*, int) override { return OPROS_UNSUPPORTED_METHOD; }

    /// The type shows in the source only, which the host asks about as well.
    bool checkType(Event*) override { return true; }
    /// Called when the host connects this port: compares the source's type with the peer's signature.
    bool checkType(EventPort* source) override;
    std::string typeError() const override { return type_error_; }

  private:
    const link::Port peer_;
    link::ChannelWriter& channel_;
    opros_any default_content_;
    std::string type_error_;
};

} // namespace tandem::adaptor
