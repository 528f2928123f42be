// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/drive/driven_rtc.hpp"
#include "proxy/interceptor/drive/rtc_transitions.hpp"
#include "proxy/interceptor/engine/rtm_api.hpp"

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace tandem::interceptor {

/// Whether that names an RTC of another process: rtcname://HOST/..., rtcloc://HOST/...
bool is_remote_name(const std::string& name);
/// What stands for its type in a port table: a link is made before the RTC may be there to tell.
inline constexpr const char* remote_type = "RTC of another process";
/// `Name0` of rtcname://HOST:PORT/CONTEXT/Name0.rtc.
std::string instance_of(const std::string& name);

/// An RTC of another process, which comes, goes and comes back. It is activated whenever it comes while the link wants it
/// active, and deactivated as soon as it answers if the link wanted that while it did not. Functions: [any-thread]
class RemoteRtc final : public DrivenRtc {
  public:
    /// Called in this object's thread; must not call this object, but for resume().
    struct Events {
        /// It is there, or has other ports than before. The calls of these references end in bounded time.
        std::function<void(const RTC::PortServiceList& ports)> ports_changed;
        std::function<void()> gone;
        /// It went to ERROR, or cannot be activated again: one line.
        std::function<void(const std::string& what)> failed;
    };
    /// `owner` begins log lines. `timeout`: see RtcTransitions.
    RemoteRtc(RTC::Manager& manager, std::string owner, std::string name, std::chrono::milliseconds timeout,
              Events events);
    /// Deactivates it if the link has activated it.
    ~RemoteRtc() override;
    RemoteRtc(const RemoteRtc&) = delete;
    RemoteRtc& operator=(const RemoteRtc&) = delete;

    /// Looks for it once. Returns its ports, none if it is not there: then `reason` is one line. [before watch()]
    RTC::PortServiceList find(std::string& reason);
    /// Starts to look for it, and at it.
    void watch();
    /// Its ports have been connected: now it may be activated, if the link wants that.
    void resume();

    /// Of an RTC that is not there: ok, since it is activated when it comes.
    std::string activate() override;
    std::string deactivate() override;
    std::string reset() override;
    bool is_active() const override;

  private:
    struct Found;
    std::shared_ptr<Found> current() const;
    std::string search();
    void run();
    void look();
    void look_at(Found& rtc);
    void lose(const char* why);
    void do_as_wanted(Found& rtc);
    bool has_gone(const std::shared_ptr<Found>& rtc) const;
    void say_once(const std::string& line);

    RTC::Manager& manager_;
    const std::string owner_, name_;
    const std::chrono::milliseconds timeout_;
    const Events events_;

    std::mutex drive_mutex_;   ///< one transition at a time; locked before mutex_
    mutable std::mutex mutex_; ///< what follows
    std::condition_variable wake_;
    std::shared_ptr<Found> found_;
    RTC::RTObject_var last_; ///< that which was found last
    bool wanted_active_ = false;
    bool is_driven_ = false; ///< the link has activated it and has not seen it inactive since
    bool ports_connected_ = false;
    bool resume_asked_ = false, stopping_ = false;

    // Of the thread.
    int failed_looks_ = 0;
    std::string last_line_;
    std::thread thread_;
};

} // namespace tandem::interceptor
