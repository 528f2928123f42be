// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/archive/refusal_record.hpp"
#include "proxy/adaptor/engine/capabilities.hpp"
#include "proxy/adaptor/engine/explaining_port.hpp"
#include "proxy/adaptor/event/event_content.hpp"
#include "proxy/link/channel/channel.hpp"
#include "proxy/link/protocol/port_table.hpp"

#include <InputEventPortInterface.h>

#include <string>

namespace tandem::adaptor {

/// The common part of the ports that take events for the peer.
class MirrorEventPortBase : public engine::ExplainingPort<InputEventPortInterface>, public RefusalRecord {
  public:
    /// `peer` is the port's entry in the peer's table. The channel must outlive this port.
    MirrorEventPortBase(link::Port peer, link::ChannelWriter& channel)
        : peer_(std::move(peer)), channel_(channel) {}

    using InputEventPortInterface::push;
    ReturnType push(opros::archive::iarchive&) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType pushEvent(unsigned char*, int) override { return OPROS_UNSUPPORTED_METHOD; }

    /// Called when the host connects this port. Returns whether the type of the event's content fits.
    bool checkType(EventPort* source) override {
        return !engine::ports_show_content || check(content_of(*source));
    }
    /// Called by the source with an event of its type when the host connects this port.
    bool checkType(Event* event) override { return engine::ports_show_content || check(content_of(*event)); }

  protected:
    const link::Port peer_;
    link::ChannelWriter& channel_;

  private:
    /// Returns whether events with content of the sample's type cross. Sets the type error.
    virtual bool accept(const opros_any& sample) = 0;
    bool check(const opros_any& sample) {
        if (accept(sample)) return true;
        record_refusal(type_error());
        return false;
    }
};

} // namespace tandem::adaptor
