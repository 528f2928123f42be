// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/drive/driven_rtc.hpp"
#include "proxy/interceptor/drive/rtc_transitions.hpp"
#include "proxy/interceptor/engine/rtm_api.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

namespace tandem::interceptor {

/// Drives one RTC of this process, in the first execution context that it owns. If an RTC's onDeactivated does not return
/// in time, the driver stops waiting; an activation requested meanwhile happens when it returns. [any-thread]
class RtcDriver final : public DrivenRtc {
  public:
    /// Must not wait.
    struct Events {
        /// Gets "went to ERROR", "has exited", or the reason why a later activation failed. Called in the thread of the
        /// event, like `activated`.
        std::function<void(const std::string& what)> failed;
        /// The RTC's onActivated has succeeded, on any caller's request.
        std::function<void()> activated;
        /// After `activated`: the RTC's state is ACTIVE. Called in another thread, like `deactivated_by_other`.
        std::function<void()> active;
        /// The RTC is inactive, and this driver has not deactivated it.
        std::function<void()> deactivated_by_other;
    };

    /// `timeout`: see RtcTransitions. Throws std::runtime_error if the RTC owns no execution context.
    RtcDriver(RTC::RTObject_impl& rtc, std::chrono::milliseconds timeout, Events events);
    ~RtcDriver() override;
    RtcDriver(const RtcDriver&) = delete;
    RtcDriver& operator=(const RtcDriver&) = delete;

    std::string activate() override;
    std::string deactivate() override;
    std::string reset() override { return transitions_->reset(); }
    bool is_active() const override { return transitions_->state() == RTC::ACTIVE_STATE; }
    void set_thread(link::TaskQueue& thread) override { thread_ = &thread; }

  private:
    class CallbackListener;

    void end_late_deactivation();
    void on_activated();
    void on_deactivated();

    RTC::RTObject_impl& rtc_;
    const std::string name_;
    std::unique_ptr<RtcTransitions> transitions_;
    const Events events_;
    std::unique_ptr<CallbackListener> error_listener_, reset_listener_, exit_listener_, activated_listener_,
        deactivated_listener_;
    std::atomic<bool> exited_{false};
    link::TaskQueue* thread_ = nullptr;
    std::mutex late_mutex_;                 ///< guards the members below
    bool deactivating_ = false;             ///< by this driver
    bool late_ = false;                     ///< onDeactivated took too long and has not returned yet
    bool wanted_ = false;                   ///< while late_: the RTC must become active
    std::uint64_t deactivations_ended_ = 0; ///< how often onDeactivated has returned
};

} // namespace tandem::interceptor
