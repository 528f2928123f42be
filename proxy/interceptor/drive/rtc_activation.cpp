// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/drive/rtc_activation.hpp"

#include "host/log/log.hpp"

namespace tandem::interceptor {

RtcActivation::RtcActivation(RTC::RTObject_impl& owner, const link::Link& link, const std::string& link_name,
                             std::chrono::milliseconds timeout)
    : owner_(owner), link_(link),
      owner_driver_(owner, timeout, {[](const std::string&) {}, [] {}, [] {}, [] {}}), rtcs_(link_name) {}

std::string RtcActivation::activate() {
    // Set first, so that peer_lost() sees it when the peer dies meanwhile.
    activated_by_link_ = true;
    // The owner is activated first, because the RTCs may use its mirrors in their onActivated.
    std::string error = owner_driver_.activate();
    if (error.empty()) error = rtcs_.activate();
    activated_by_link_ = error.empty(); // also if peer_lost() came before the RTCs were active
    // If the peer has gone before the RTCs were active, nobody else deactivates them.
    if (!link_.is_up()) peer_lost();
    return error;
}

std::string RtcActivation::deactivate() {
    std::string error = rtcs_.deactivate();
    activated_by_link_ = false;
    return error;
}

void RtcActivation::peer_lost() {
    // An RTC that another client has activated keeps running: it does not depend on the link.
    if (!activated_by_link_.exchange(false)) return;
    // Does not wait: a slow RTC must not delay the next peer, whose activation is queued after this deactivation.
    rtcs_.begin_deactivation([name = std::string(owner_.getInstanceName())](const std::string& error) {
        log::error("{}: {}", name, error);
    });
}

} // namespace tandem::interceptor
