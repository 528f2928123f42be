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

/// Drives all RTCs behind one link together: in the order in which they were added, and for deactivation in reverse order.
/// An RTC that takes longer than control::head_start continues in parallel with the next ones; the transitions of each RTC
/// happen one at a time. activate(), deactivate() and reset() return an empty string or an error of one line. [any-thread]
/// except add()
class RtcGroup {
  public:
    /// `link` is the link's name in log lines.
    explicit RtcGroup(std::string link) : link_(std::move(link)) {}
    ~RtcGroup();
    RtcGroup(const RtcGroup&) = delete;
    RtcGroup& operator=(const RtcGroup&) = delete;

    void add(std::unique_ptr<DrivenRtc> rtc);
    /// Activates all RTCs. If one cannot be activated, deactivates those that this call has activated.
    std::string activate();
    std::string deactivate();
    /// Deactivates like deactivate(), but does not wait for RTCs that take longer than control::head_start. `on_error` is
    /// called with a line, in any thread, until this object is destroyed.
    void begin_deactivation(const std::function<void(const std::string& error)>& on_error);
    /// Resets the RTCs that are in ERROR.
    std::string reset();
    bool are_all_active() const;
    /// Ends the threads of the RTCs. No event occurs afterwards, and transitions that have not begun do not run.
    void stop();

  private:
    struct Member {
        std::unique_ptr<link::TaskQueue> thread; ///< makes all transitions of the RTC; outlives it
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
