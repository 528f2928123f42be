// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/remote/remote_rtc.hpp"
#include "proxy/interceptor/rtc_port.hpp"
#include "proxy/interceptor/settings.hpp"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tandem::interceptor {

/// The RTCs of other processes that the link shares. They come and go. Their ports have the mirrors that ports of this
/// process have, connected by CORBA. RTCs are named by their instance names, except where the parameter `rtc` is meant.
class RemoteRtcs {
  public:
    /// Called in the RTC's own thread; see RemoteRtc::Events.
    struct Events {
        /// The RTC has appeared, or has other ports than before: call resume() when they are connected.
        std::function<void(const std::string& rtc, const std::vector<RtcPort>& ports)> ports_changed;
        std::function<void(const std::string& rtc)> gone;
        std::function<void(const std::string& rtc, const std::string& what)> failed;
        std::function<void(const std::string& rtc)> active;
    };
    /// `owner` begins log lines. The settings must outlive this object.
    RemoteRtcs(std::string owner, const Settings& settings, Events events);

    /// Looks once for the RTCs in `names` that are in other processes, and adds those that exist to `shared`. `names` are
    /// those of the parameter `rtc`. Throws std::runtime_error if two RTCs have one name, or if one does not exist and
    /// `strict` is set.
    void find(const std::vector<std::string>& names, SharedRtcs& shared);
    /// Hands the RTC with this name in the parameter `rtc` over to its new owner, who destroys it before this object.
    std::unique_ptr<RemoteRtc> take(const std::string& name);
    /// Starts to look for the RTCs, and to watch them, when the ports that find() has found are connected.
    void watch();
    /// See RemoteRtc::resume(). [any-thread]
    void resume(const std::string& rtc);

  private:
    struct Found {
        RemoteRtc* rtc;
        std::unique_ptr<RemoteRtc> untaken; ///< the same, until take()
    };
    std::unique_ptr<RemoteRtc> make(const std::string& name, bool is_only) const;

    const std::string owner_;
    const Settings& settings_;
    const Events events_;
    std::map<std::string, Found> found_; ///< changed by find() and take() only
};

} // namespace tandem::interceptor
