// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/transport/remote_endpoints.hpp"

namespace RTC {

/// Adds a ring of shared memory to `calls`, the receiver of the same connection in another process, if that
/// process is on this machine, has published that it can read a ring, and opens it. Otherwise returns `calls`. Waits up
/// to `answer_timeout`.
std::unique_ptr<RemoteReceiver> add_ring_if_possible(std::unique_ptr<RemoteReceiver> calls,
                                                     const ConnectorProfile& profile,
                                                     std::chrono::milliseconds answer_timeout);

} // namespace RTC
