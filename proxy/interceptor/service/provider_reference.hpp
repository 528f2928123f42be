// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/engine/rtm_api.hpp"

#include <atomic>
#include <chrono>
#include <deque>
#include <mutex>

namespace tandem::interceptor {

/// The reference to a provider's object. A CorbaPort sets and releases it while threads call through it. A reader takes no
/// lock and counts nothing: the reference that it has read stays valid for longer than any call may last.
class ProviderReference final : public RTC::CorbaConsumerBase {
  public:
    bool setObject(CORBA::Object_ptr object) override; ///< [any-thread]
    /// Returns the reference without duplicating it; nil without a provider. Valid for longest_call from then on.
    /// [any-thread]
    CORBA::Object_ptr getObject() override { return current_.load(std::memory_order_acquire); }
    void releaseObject() override; ///< [any-thread]

    /// The bound of a CallHandle is at most 24 h.
    static constexpr std::chrono::hours longest_call{25};

  private:
    using Clock = std::chrono::steady_clock;
    struct Kept {
        CORBA::Object_var object;
        Clock::time_point released_at;
    };
    void release_locked();

    std::atomic<CORBA::Object_ptr> current_{CORBA::Object::_nil()};
    std::mutex mutex_;      ///< the one below
    std::deque<Kept> kept_; ///< in the order in which they were set; the last one may be current
};

} // namespace tandem::interceptor
