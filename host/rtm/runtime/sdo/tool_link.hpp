// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/process/published/notices.hpp"
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <omniORB4/CORBA.h>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace RTC {

/// Calls the object that a tool has given to a component: in order, without results, in a separate thread. So a tool that
/// hangs delays no component. Calls dynamically, because a component's library may contain another edition of the tool's
/// IDL. [any-thread]
class ToolLink {
  public:
    using Clock = std::chrono::steady_clock;
    /// The arguments of one call. A struct is the sequence of its members and an enumerator is its number: both have these
    /// bytes in CDR.
    using Arguments = std::vector<CORBA::Any>;
    /// What the link's thread does once every period.
    struct Periodic {
        std::chrono::nanoseconds period;
        std::function<void()> run;
        Clock::time_point due = Clock::now() + period;
    };

    /// `name` is used in log lines. The tasks may call send(), so they only run after start().
    ToolLink(CORBA::Object_ptr tool, std::string name, std::vector<Periodic> periodic = {});
    ~ToolLink() { finish(); }
    ToolLink(const ToolLink&) = delete;
    ToolLink& operator=(const ToolLink&) = delete;

    /// Starts the thread. Throws NotStarted if there can be none.
    void start();
    /// Lets the thread make the calls that wait, for 2 s at most and one call, and then end. Runs no more tasks. Does not
    /// wait.
    void request_end();
    /// Calls request_end() and waits for the end of the thread, which may still call send().
    void finish();

    /// `operation` is a literal. Drops the call if the tool is lost or 1000 calls wait.
    void send(const char* operation, Arguments arguments);
    /// Returns whether the tool has stopped answering. Nothing is sent to it any more.
    bool is_lost() const { return lost_; }

  private:
    struct Call {
        const char* operation;
        Arguments arguments;
    };
    void run();
    void make_all(const std::deque<Call>& calls);
    bool make(const Call& call) const;
    void run_due_tasks();

    const CORBA::Object_var tool_;
    const std::string name_;
    std::vector<Periodic> periodic_; // only used by the thread
    std::mutex mutex_;               // guards what follows; not held during calls
    std::condition_variable wake_;
    std::deque<Call> calls_;
    bool stopping_ = false;
    bool has_dropped_ = false;
    std::atomic<bool> lost_ = false;
    std::atomic<Clock::time_point> deadline_{Clock::time_point::max()}; // of all calls, when the link ends
    std::optional<tandem::process::OwnNotice> notice_; // while the tool is lost; made by the thread
    std::thread thread_;
};

} // namespace RTC
