// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/sdo/tool_link.hpp"
#include "host/process/start_thread.hpp"
#include <algorithm>
#include <rtm/SystemLogger.h>
#include <utility>

namespace RTC {
namespace {

constexpr std::size_t max_waiting_calls = 1000;
constexpr CORBA::ULong call_timeout_ms = 2000;
constexpr std::chrono::seconds check_period{10};

} // namespace

ToolLink::ToolLink(CORBA::Object_ptr tool, std::string name, std::vector<Periodic> periodic)
    : tool_(CORBA::Object::_duplicate(tool)), name_(std::move(name)), periodic_(std::move(periodic)) {
    omniORB::setClientCallTimeout(tool_.in(), call_timeout_ms);
    // A call without a result does not report that the tool's object is gone.
    periodic_.push_back({check_period, [this] {
                             if (tool_->_non_existent()) lost_ = true;
                         }});
}

void ToolLink::start() {
    thread_ = tandem::process::start_thread([this] { run(); });
}

void ToolLink::request_end() {
    std::lock_guard<std::mutex> lock(mutex_);
    if (std::exchange(stopping_, true)) return;
    deadline_ = Clock::now() + std::chrono::milliseconds(call_timeout_ms);
    wake_.notify_one();
}

void ToolLink::finish() {
    request_end();
    if (thread_.joinable()) thread_.join();
}

void ToolLink::send(const char* operation, Arguments arguments) {
    {
        std::lock_guard<std::mutex> lock(mutex_);
        if (lost_) return;
        if (calls_.size() < max_waiting_calls) {
            calls_.push_back({operation, std::move(arguments)});
            wake_.notify_one();
            return;
        }
        if (std::exchange(has_dropped_, true)) return;
    }
    Logger rtclog("tools");
    RTC_WARN(("%s takes messages more slowly than they are produced: some are not sent", name_.c_str()));
}

void ToolLink::run() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (!lost_) {
        const auto due = std::min_element(periodic_.begin(), periodic_.end(), [](auto& a, auto& b) {
                             return a.due < b.due;
                         })->due;
        wake_.wait_until(lock, due, [this] { return stopping_ || !calls_.empty(); });
        if (stopping_ && calls_.empty()) return;
        const std::deque<Call> calls = std::exchange(calls_, {});
        const bool runs_tasks = !stopping_;
        lock.unlock();
        try {
            make_all(calls);
            if (runs_tasks) run_due_tasks();
        } catch (const CORBA::SystemException&) {
            lost_ = true; // of a task: the tool does not answer
        }
        lock.lock();
    }
    calls_.clear();
    lock.unlock();
    const std::string line = name_ + " does not answer: nothing is sent to it any more";
    Logger rtclog("tools");
    RTC_INFO(("%s", line.c_str()));
    notice_.emplace(tandem::process::NoticeKind::lost, line);
}

void ToolLink::make_all(const std::deque<Call>& calls) {
    for (const auto& call : calls) {
        if (Clock::now() > deadline_.load()) return;
        if (make(call)) continue;
        lost_ = true;
        return;
    }
}

void ToolLink::run_due_tasks() {
    const auto now = Clock::now();
    for (auto& task : periodic_) {
        if (lost_ || task.due > now) continue;
        task.due = now + task.period;
        task.run();
    }
}

// omniORB stores the exception of a dynamic call, or throws it if its option diiThrowsSysExceptions is set.
bool ToolLink::make(const Call& call) const {
    try {
        CORBA::Request_var request = tool_->_request(call.operation);
        for (const auto& argument : call.arguments) request->add_in_arg() = argument;
        request->send_oneway();
        return request->env()->exception() == nullptr;
    } catch (const CORBA::SystemException&) {
        return false;
    }
}

} // namespace RTC
