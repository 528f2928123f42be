// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/event/mirror_event_port_base.hpp"
#include "proxy/adaptor/names/peer_names.hpp"
#include "proxy/wire/type.hpp"

#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace tandem::adaptor {

/// Mirrors an EventInPort of the peer, whose messages are events of a state machine. An event goes to the handler of its
/// id; its content is the argument, without RTM's time, or is left out where the handler has none. Several ports may
/// send here, with contents of types of their own.
class MirrorFsmPort final : public MirrorEventPortBase {
  public:
    /// `peer` is the port's entry in the peer's table. The channel must outlive this port.
    MirrorFsmPort(link::Port peer, link::ChannelWriter& channel, PeerNames names = {});

    /// OPROS_OUT_OF_RESOURCES: no peer, or no room; OPROS_BAD_INPUT_PARAMETER: the peer has no such event, or with
    /// another argument, which is counted as a dropped message. An event without content has its type's default value.
    ReturnType push(Event* event) override;
    using MirrorEventPortBase::push;

  private:
    /// True if the content fits at least one event. Logs a line about those that it does not fit.
    bool accept(const opros_any& sample) override;

    struct PeerEvent {
        std::string problem;     ///< why it cannot cross; empty if it can
        std::string signature{}; ///< of its argument, without RTM's time; empty: it has none
        wire::Type argument{};
    };
    /// The contents of one connected port's events.
    struct Content {
        opros_any sample;
        std::string signature;
        std::set<std::string> events; ///< ids of the events that take it
    };
    const opros_any* argument_of(Event& event, const std::string& id) const;
    std::string describe_events() const;
    ReturnType refuse(Event& event);

    const PeerNames names_;
    std::map<std::string, PeerEvent> events_;
    std::mutex mutex_;                        ///< the two below
    std::map<std::string, Content> contents_; ///< by their types
    std::vector<std::byte> argument_;         ///< kept for its memory
};

} // namespace tandem::adaptor
