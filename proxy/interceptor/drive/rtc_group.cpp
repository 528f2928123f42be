// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/drive/rtc_group.hpp"

#include <algorithm>

namespace tandem::interceptor {

std::string RtcGroup::activate() {
    std::vector<DrivenRtc*> activated;
    for (const auto& rtc : rtcs_) {
        const bool was_active = rtc->is_active();
        std::string error = rtc->activate();
        if (error.empty()) {
            if (!was_active) activated.push_back(rtc.get());
            continue;
        }
        std::for_each(activated.rbegin(), activated.rend(), [](DrivenRtc* each) { each->deactivate(); });
        return error;
    }
    return "";
}

std::string RtcGroup::deactivate() {
    std::string first_error;
    for (auto rtc = rtcs_.rbegin(); rtc != rtcs_.rend(); ++rtc) {
        std::string error = (*rtc)->deactivate();
        if (first_error.empty()) first_error = std::move(error);
    }
    return first_error;
}

std::string RtcGroup::reset() {
    std::string first_error;
    for (const auto& rtc : rtcs_) {
        std::string error = rtc->reset();
        if (first_error.empty()) first_error = std::move(error);
    }
    return first_error;
}

} // namespace tandem::interceptor
