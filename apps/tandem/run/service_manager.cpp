// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/run/service_manager.hpp"

#include <systemd/sd-daemon.h>

#include <algorithm>
#include <cstdint>

namespace tandem::command {

ServiceManager::ServiceManager() {
    std::uint64_t limit_us = 0;
    if (sd_watchdog_enabled(0, &limit_us) > 0) pause_ = std::chrono::microseconds(limit_us / 4);
}

void ServiceManager::report_ready() { sd_notify(0, "READY=1"); }

void ServiceManager::report_stopping() { sd_notify(0, "STOPPING=1"); }

void ServiceManager::report_status(const std::string& line) {
    std::string text = line;
    std::replace(text.begin(), text.end(), '\n', ' '); // would begin another assignment
    sd_notify(0, ("STATUS=" + text).c_str());
}

void ServiceManager::keep_alive() {
    if (pause_.count() == 0) return;
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    next_ = now + pause_;
    sd_notify(0, "WATCHDOG=1");
}

} // namespace tandem::command
