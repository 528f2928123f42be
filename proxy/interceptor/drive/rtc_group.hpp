// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/drive/driven_rtc.hpp"
#include "proxy/link/task_queue.hpp"

#include <functional>
#include <future>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tandem::interceptor {

/// The RTCs behind one link, driven together: in the order in which they were added, and deactivated in the reverse order.
/// One that takes longer than control::head_start goes on beside those after it; the transitions of each come one after the
/// other. activate(), deactivate() and reset() return an empty string or an error of one line. [any-thread] but add()
class RtcGroup {
  public:
    /// `link` names it in log lines.
    explicit RtcGroup(std::string link) : link_(std::move(link)) {}
    ~RtcGroup();
    RtcGroup(const RtcGroup&) = delete;
    RtcGroup& operator=(const RtcGroup&) = delete;

    void add(std::unique_ptr<DrivenRtc> rtc);
    /// If one cannot be activated, those that this call has activated are deactivated again.
    std::string activate();
    std::string deactivate();
    /// The same, but does not wait for those that take longer than control::head_start. `on_error` is called with a line in
    /// any thread, until this object goes.
    void begin_deactivation(const std::function<void(const std::string& error)>& on_error);
    /// Resets those that are in ERROR.
    std::string reset();

  private:
    struct Member {
        std::unique_ptr<link::TaskQueue>
            thread; ///< in which all transitions of the RTC are made; outlives it
        std::unique_ptr<DrivenRtc> rtc;
    };
    struct Outcome {
        std::string error;
        bool activated = false; ///< and was not active before
    };
    using Transition = std::function<Outcome(DrivenRtc&)>;
    struct Begun {
        Member* member;
        std::shared_future<Outcome> outcome;
    };
    static Begun begin(Member& member, Transition transition);
    static std::string first_error(const std::vector<Begun>& begun);

    const std::string link_;
    std::vector<Member> members_;
};

} // namespace tandem::interceptor
