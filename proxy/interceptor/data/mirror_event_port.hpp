// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/process/log_throttle.hpp"
#include "proxy/interceptor/engine/rtm_api.hpp"
#include "proxy/link/channel/channel.hpp"
#include "proxy/link/protocol/port_table.hpp"

#include <map>
#include <string>

namespace tandem::interceptor {

/// Mirrors an EventInPort of the shared RTC: an OutPort with one connection to it for each event, under the event's name.
/// Messages from the link, an id and an `any` with the argument, go to the connection of this id.
class MirrorEventPort final : public RTC::OutPortBase {
  public:
    /// `port` is the EventInPort's entry in the port table. The channel must outlive this port.
    MirrorEventPort(const link::Port& port, link::ChannelReader& channel);

    /// Delivers all events that have come, in order. [notifier-thread]
    void deliver();
    bool write() override { return false; }

  private:
    struct Argument {
        std::string signature; ///< without RTM's time; empty: the event has none
        bool timed = false;    ///< begins with RTM's time, which travels in the record's header
    };
    void take(const shm::Record& record);
    bool send();

    std::map<std::string, Argument, std::less<>> events_;
    link::ChannelReader& channel_;
    std::string id_;                ///< of the event taken last; empty if it cannot be used
    RTC::ByteData message_;         ///< its argument, as the RTC's port expects it
    shm::MessageSnapshot snapshot_; ///< of a long message that is read more than once
    process::LogThrottle undecodable_, undelivered_;
};

} // namespace tandem::interceptor
