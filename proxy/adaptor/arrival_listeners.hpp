// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/engine/arrival_listener.hpp"
#include "proxy/link/link.hpp"

#include <map>
#include <mutex>

namespace tandem::adaptor {

/// The listeners to messages of a link's channels. Lets a listener's thread sleep on the link's doorbell, so that the
/// peer's message wakes no other thread first. The link must outlive it.
class ArrivalListeners final : private engine::ArrivalWaiter {
  public:
    explicit ArrivalListeners(link::Link& link) : link_(link) {}
    /// Sets the listener of a channel; nullptr: none. On return the earlier listener is not in use: waits until its thread
    /// has left the link. [any-thread but the listeners']
    void set(const link::ChannelReader& channel, engine::ArrivalListener* listener);

  private:
    Result wait(const engine::ArrivalListener& listener) override;
    void wake(const engine::ArrivalListener& listener) override { link_.wake_consumer(&listener); }

    link::Link& link_;
    std::mutex mutex_; ///< guards the listeners, and keeps the link's consistent with them
    std::map<const link::ChannelReader*, engine::ArrivalListener*> listeners_;
};

} // namespace tandem::adaptor
