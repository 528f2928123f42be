// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/engine/rtm_api.hpp"

#include <functional>
#include <memory>
#include <string>

namespace tandem::interceptor {

/// Reports ports that are added to an RTC or removed from it.
class RtcPortWatcher {
  public:
    enum class Change { added, removed };
    /// `changed` gets the port's name without the RTC's name, in the thread that changes the ports. It must not wait.
    RtcPortWatcher(RTC::RTObject_impl& rtc,
                   const std::function<void(const std::string& port, Change change)>& changed);
    ~RtcPortWatcher();
    RtcPortWatcher(const RtcPortWatcher&) = delete;
    RtcPortWatcher& operator=(const RtcPortWatcher&) = delete;

  private:
    class Listener;
    RTC::RTObject_impl& rtc_;
    const std::string name_;
    std::unique_ptr<Listener> added_, removed_;
};

} // namespace tandem::interceptor
