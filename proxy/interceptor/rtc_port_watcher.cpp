// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/rtc_port_watcher.hpp"

#include "proxy/interceptor/rtc_port.hpp"

namespace tandem::interceptor {

class RtcPortWatcher::Listener final : public RTC::PortActionListener {
  public:
    Listener(std::function<void(const std::string&, Change)> changed, Change change)
        : changed_(std::move(changed)), change_(change) {}
    void operator()(const RTC::PortProfile& profile) override { changed_(short_name(profile), change_); }

  private:
    const std::function<void(const std::string&, Change)> changed_;
    const Change change_;
};

RtcPortWatcher::RtcPortWatcher(RTC::RTObject_impl& rtc,
                               const std::function<void(const std::string&, Change)>& changed)
    : rtc_(rtc), name_(rtc.getInstanceName()), added_(std::make_unique<Listener>(changed, Change::added)),
      removed_(std::make_unique<Listener>(changed, Change::removed)) {
    rtc_.addPortActionListener(RTC::PortActionListenerType::ADD_PORT, added_.get(), false);
    rtc_.addPortActionListener(RTC::PortActionListenerType::REMOVE_PORT, removed_.get(), false);
}

RtcPortWatcher::~RtcPortWatcher() {
    // The RTC may have been deleted before this object: then `rtc_` dangles.
    if (RTC::Manager::instance().getComponent(name_.c_str()) != &rtc_) return;
    rtc_.removePortActionListener(RTC::PortActionListenerType::ADD_PORT, added_.get());
    rtc_.removePortActionListener(RTC::PortActionListenerType::REMOVE_PORT, removed_.get());
}

} // namespace tandem::interceptor
