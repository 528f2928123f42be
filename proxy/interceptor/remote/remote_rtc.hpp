// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/process/published/notices.hpp"
#include "proxy/interceptor/drive/driven_rtc.hpp"
#include "proxy/interceptor/drive/rtc_transitions.hpp"
#include "proxy/interceptor/engine/rtm_api.hpp"

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace tandem::interceptor {

/// Returns whether this is the name of an RTC of another process: rtcname://HOST/..., rtcloc://HOST/...
bool is_remote_name(const std::string& name);
/// Replaces the type in a port table: the link is created before the RTC may be there to tell its type.
inline constexpr const char* remote_type = "RTC of another process";
/// Returns `Name0` for rtcname://HOST:PORT/CONTEXT/Name0.rtc.
std::string instance_of(const std::string& name);

/// An RTC of another process, which comes, goes and returns. Whenever it comes while the link wants it active, it is
/// activated. If the link wanted it inactive while it did not answer, it is deactivated as soon as it answers. [any-thread]
class RemoteRtc final : public DrivenRtc {
  public:
    /// Called in this object's thread. Must not call this object, except for resume().
    struct Events {
        /// Called when the RTC has appeared, or has other ports than before. Calls through these references end in bounded
        /// time.
        std::function<void(const RTC::PortServiceList& ports)> ports_changed;
        std::function<void()> gone;
        /// Called when the RTC went to ERROR or cannot be activated again; `what` is one line.
        std::function<void(const std::string& what)> failed;
        /// Called when the RTC has become active, on any caller's request.
        std::function<void()> active;
    };
    /// `owner` begins log lines. `timeout`: see RtcTransitions.
    RemoteRtc(RTC::Manager& manager, std::string owner, std::string name, std::chrono::milliseconds timeout,
              Events events);
    /// Deactivates the RTC if the link has activated it.
    ~RemoteRtc() override;
    RemoteRtc(const RemoteRtc&) = delete;
    RemoteRtc& operator=(const RemoteRtc&) = delete;

    /// Looks for the RTC once. Returns its ports; none, and `reason` in one line, if it was not found. [before watch()]
    RTC::PortServiceList find(std::string& reason);
    /// Starts the thread that looks for the RTC and watches it.
    void watch();
    /// Call it when the RTC's ports are connected: from now on it may be activated, if the link wants that.
    void resume();

    /// Returns ok for an RTC that is not available: it is activated when it appears.
    std::string activate() override;
    std::string deactivate() override;
    std::string reset() override;
    bool is_active() const override;

  private:
    struct Found;
    std::shared_ptr<Found> current() const;
    void publish_absence();
    std::string search();
    void run();
    void look();
    void look_at(Found& rtc);
    void report_deactivation();
    void lose(const char* why);
    void do_as_wanted(Found& rtc);
    bool has_gone(const std::shared_ptr<Found>& rtc) const;
    void say_once(const std::string& line);

    RTC::Manager& manager_;
    const std::string owner_, name_;
    const std::chrono::milliseconds timeout_;
    const Events events_;

    std::mutex drive_mutex_;   ///< one transition at a time; locked before mutex_
    mutable std::mutex mutex_; ///< guards the members below
    std::condition_variable wake_;
    std::shared_ptr<Found> found_;
    std::optional<process::OwnNotice> missing_; ///< for observers, while it is not there
    RTC::RTObject_var last_;                    ///< the reference found last
    bool wanted_active_ = false;
    bool is_driven_ = false; ///< the link has activated it and has not seen it inactive since
    bool ports_connected_ = false;
    bool resume_asked_ = false, stopping_ = false;

    // Used only by the thread.
    int failed_looks_ = 0;
    std::string last_line_;
    std::thread thread_;
};

} // namespace tandem::interceptor
