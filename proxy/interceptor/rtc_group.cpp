// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/rtc_group.hpp"

#include <algorithm>

namespace tandem::interceptor {

void RtcGroup::add(RTC::RTObject_impl& rtc, std::chrono::milliseconds timeout,
                   const RtcDriver::Report& report) {
    drivers_.push_back(std::make_unique<RtcDriver>(rtc, timeout, report));
}

std::string RtcGroup::activate() {
    std::vector<RtcDriver*> activated;
    for (const auto& driver : drivers_) {
        const bool was_active = driver->is_active();
        std::string error = driver->activate();
        if (error.empty()) {
            if (!was_active) activated.push_back(driver.get());
            continue;
        }
        std::for_each(activated.rbegin(), activated.rend(), [](RtcDriver* each) { each->deactivate(); });
        return error;
    }
    return "";
}

std::string RtcGroup::deactivate() {
    std::string first_error;
    for (auto driver = drivers_.rbegin(); driver != drivers_.rend(); ++driver) {
        std::string error = (*driver)->deactivate();
        if (first_error.empty()) first_error = std::move(error);
    }
    return first_error;
}

std::string RtcGroup::reset() {
    std::string first_error;
    for (const auto& driver : drivers_) {
        std::string error = driver->reset();
        if (first_error.empty()) first_error = std::move(error);
    }
    return first_error;
}

} // namespace tandem::interceptor
