// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <rtm/RTObject.h>
#include <string>
#include <vector>

namespace RTC {

/// Calls `tell` with `SEND:OutPort:NAME` and `RECEIVE:InPort:NAME` when a data port sends or receives a message, at most once
/// per interval and port. The intervals are `port_profile.send_event.min_interval` and `receive_event` (s); without one, the
/// ports get no listener, because each costs time for every message. Returns functions that remove the listeners.
std::vector<std::function<void()>> listen_to_messages(RTObject_impl& component,
                                                      const coil::Properties& settings,
                                                      const std::function<void(const std::string&)>& tell);

} // namespace RTC
