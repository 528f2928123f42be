// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/event/mirror_event_port_base.hpp"

#include <mutex>

namespace tandem::adaptor {

/// Mirrors an input data port of the peer as an event port. Encodes the event's id and content into the link's channel, in
/// the thread that delivers events to AdaptorComp. Never blocks.
class MirrorEventInPort final : public MirrorEventPortBase {
  public:
    /// `peer` is the port's entry in the peer's table. The channel must outlive this port.
    using MirrorEventPortBase::MirrorEventPortBase;

    /// Returns OPROS_OUT_OF_RESOURCES if there is no room, and OPROS_BAD_INPUT_PARAMETER if this event cannot
    /// be encoded. An event without content has the default value of its type.
    ReturnType push(Event* event) override;
    using MirrorEventPortBase::push;

  private:
    /// Returns whether the type matches the peer's signature.
    bool accept(const opros_any& sample) override;

    std::mutex content_mutex_; ///< a connection may be made while another one sends
    opros_any default_content_;
};

} // namespace tandem::adaptor
