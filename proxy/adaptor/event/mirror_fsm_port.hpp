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
/// id. Its content is the argument, without RTM's time; it is left out if the handler has no argument. Several ports with
/// different content types may send here.
class MirrorFsmPort final : public MirrorEventPortBase {
  public:
    /// `peer` is the port's entry in the peer's table. The channel must outlive this port.
    MirrorFsmPort(link::Port peer, link::ChannelWriter& channel, PeerNames names = {});

    /// Returns OPROS_OUT_OF_RESOURCES if there is no room, and OPROS_BAD_INPUT_PARAMETER if the peer has no such
    /// event or one with another argument; this counts as a dropped message. An event without content has the default value
    /// of its type.
    ReturnType push(Event* event) override;
    using MirrorEventPortBase::push;

  private:
    /// Returns true if the content fits at least one event. Logs a line about the events that it does not fit.
    bool accept(const opros_any& sample) override;

    struct PeerEvent {
        std::string problem;     ///< why it cannot cross; empty if it can
        std::string signature{}; ///< of its argument, without RTM's time; empty: none
        wire::Type argument{};
    };
    /// The contents of the events of one connected port.
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
