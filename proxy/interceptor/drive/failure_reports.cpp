// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/drive/failure_reports.hpp"

#include "proxy/link/protocol/control.hpp"

#include <fmt/format.h>

namespace tandem::interceptor {
namespace control = link::control;

void FailureReports::add(const std::string& rtc, const std::string& what) {
    {
        const std::lock_guard lock(mutex_);
        unsent_[rtc].insert(fmt::format("RTC '{}' {}", rtc, what));
    }
    link_.post([this] { send(); });
}

void FailureReports::withdraw(const std::string& rtc) {
    const std::lock_guard lock(mutex_);
    unsent_.erase(rtc);
}

void FailureReports::send() {
    std::map<std::string, std::set<std::string>> reports;
    {
        const std::lock_guard lock(mutex_);
        reports.swap(unsent_);
    }
    for (const auto& [rtc, lines] : reports)
        for (const auto& line : lines) {
            const auto text = control::encode_string(line);
            if (link_.call({"", control::failed, "", text}, control::command_timeout(call_timeout_)).status ==
                link::CallStatus::ok) {
                peer_knows_failure_ = true;
                continue;
            }
            const std::lock_guard lock(mutex_);
            unsent_[rtc].insert(line);
        }
}

void FailureReports::send_recovery() {
    if (!peer_knows_failure_) return;
    const auto reply = link_.call({"", control::recovered, "", {}}, control::command_timeout(call_timeout_));
    if (reply.status == link::CallStatus::ok) peer_knows_failure_ = false;
}

} // namespace tandem::interceptor
