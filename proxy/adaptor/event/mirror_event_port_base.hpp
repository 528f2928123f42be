// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/channel/channel.hpp"
#include "proxy/link/protocol/port_table.hpp"

#include <InputEventPortInterface.h>

#include <string>

namespace tandem::adaptor {

/// What the ports that take events for the peer have in common.
class MirrorEventPortBase : public InputEventPortInterface {
  public:
    /// `peer` is the port's entry in the peer's table. The channel must outlive this port.
    MirrorEventPortBase(link::Port peer, link::ChannelWriter& channel)
        : peer_(std::move(peer)), channel_(channel) {}

    using InputEventPortInterface::push;
    ReturnType push(opros::archive::iarchive&) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType pushEvent(unsigned char*, int) override { return OPROS_UNSUPPORTED_METHOD; }

    /// The type shows in the source only, which the host asks about as well.
    using InputEventPortInterface::checkType;
    bool checkType(Event*) override { return true; }
    std::string typeError() const override { return type_error_; }

  protected:
    const link::Port peer_;
    link::ChannelWriter& channel_;
    std::string type_error_; ///< set by checkType()
};

} // namespace tandem::adaptor
