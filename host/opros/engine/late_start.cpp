// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/late_start.hpp"

#include "host/process/start_thread.hpp"

#include <algorithm>
#include <chrono>

namespace tandem::engine {

LateStart::LateStart(ApplicationDirectory& directory, std::vector<std::string> components)
    : directory_(directory), components_(std::move(components)),
      thread_(process::start_thread([this] { run(); })) {}

LateStart::~LateStart() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    wake_.notify_all();
    thread_.join();
}

void LateStart::run() {
    std::chrono::seconds interval{1};
    constexpr std::chrono::seconds max_interval{10};
    std::unique_lock lock(mutex_);
    while (!components_.empty() && !wake_.wait_for(lock, interval, [this] { return stopping_; })) {
        lock.unlock();
        interval = std::min(2 * interval, max_interval);
        std::erase_if(components_, [this](const std::string& name) { return directory_.start_again(name); });
        lock.lock();
    }
}

} // namespace tandem::engine
