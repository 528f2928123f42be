// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/drive/failure_reports.hpp"

#include "proxy/link/protocol/control.hpp"

#include <fmt/format.h>

namespace tandem::interceptor {
namespace control = link::control;

void FailureReports::add(const std::string& rtc, const std::string& what) {
    {
        const std::lock_guard lock(mutex_);
        unsent_.insert(fmt::format("RTC '{}' {}", rtc, what));
    }
    link_.post([this] { send(); });
}

void FailureReports::send() {
    std::set<std::string> lines;
    {
        const std::lock_guard lock(mutex_);
        lines.swap(unsent_);
    }
    for (const auto& line : lines) {
        const auto text = control::encode_string(line);
        if (link_.call({"", control::failed, "", text}, control::command_timeout(call_timeout_)).status ==
            link::CallStatus::ok)
            continue;
        const std::lock_guard lock(mutex_);
        unsent_.insert(line);
    }
}

} // namespace tandem::interceptor
