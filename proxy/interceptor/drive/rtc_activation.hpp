// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/drive/driven_rtc.hpp"
#include "proxy/interceptor/drive/rtc_driver.hpp"
#include "proxy/interceptor/drive/rtc_group.hpp"
#include "proxy/interceptor/engine/rtm_api.hpp"
#include "proxy/link/link.hpp"

#include <atomic>
#include <chrono>
#include <memory>
#include <string>

namespace tandem::interceptor {

/// Activates, deactivates and resets the RTCs behind a link when the peer asks for it, and deactivates them if the peer
/// dies. activate(), deactivate() and reset() return an empty string or an error of one line. [any-thread] except add()
class RtcActivation {
  public:
    /// `owner` is InterceptorComp, which is activated before the RTCs. `link_name`: for log lines. `timeout`: see
    /// RtcTransitions. The references must outlive this object. Throws like RtcDriver.
    RtcActivation(RTC::RTObject_impl& owner, const link::Link& link, const std::string& link_name,
                  std::chrono::milliseconds timeout);

    void add(std::unique_ptr<DrivenRtc> rtc) { rtcs_.add(std::move(rtc)); }
    std::string activate();
    std::string deactivate();
    std::string reset() { return rtcs_.reset(); }
    /// Deactivates the RTCs that the link has activated, without waiting for slow ones. Call it when the peer has gone.
    void peer_lost();
    /// Call it before the destructor if the events of the RTCs use this object.
    void stop() { rtcs_.stop(); }
    bool are_all_active() const { return rtcs_.are_all_active(); }
    /// Returns whether the peer wants the RTCs to be active.
    bool is_activated_by_link() const { return activated_by_link_; }
    bool owner_is_active() const { return owner_driver_.is_active(); }

  private:
    RTC::RTObject_impl& owner_;
    const link::Link& link_;
    RtcDriver owner_driver_;
    RtcGroup rtcs_;
    std::atomic<bool> activated_by_link_{false}; ///< then the RTCs are deactivated when the peer leaves
};

} // namespace tandem::interceptor
