// SPDX-License-Identifier: Apache-2.0
// The former name of ring_sender.hpp, until out_port_base.cpp includes that.
#pragma once
#include "host/rtm/runtime/transport/ring/ring_sender.hpp"

namespace RTC {

/// add_ring_if_possible()
inline std::unique_ptr<RemoteReceiver> put_ring_before(std::unique_ptr<RemoteReceiver> calls,
                                                       const ConnectorProfile& profile,
                                                       std::chrono::milliseconds answer_timeout) {
    return add_ring_if_possible(std::move(calls), profile, answer_timeout);
}

} // namespace RTC
