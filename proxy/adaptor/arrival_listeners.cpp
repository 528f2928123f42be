// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/arrival_listeners.hpp"

#include <algorithm>
#include <utility>

namespace tandem::adaptor {

void ArrivalListeners::set(const link::ChannelReader& channel, engine::ArrivalListener* listener) {
    const std::lock_guard lock(mutex_);
    if (listener)
        link_.set_arrival_listener(
            channel, [listener] { listener->arrived(); }, listener);
    else
        link_.set_arrival_listener(channel, {});
    auto* const last = std::exchange(listeners_[&channel], listener);
    if (!listener) listeners_.erase(&channel);
    // A thread that still listens to another channel keeps the waiter.
    const auto has_another = [&] {
        return std::any_of(listeners_.begin(), listeners_.end(),
                           [&](const auto& each) { return each.second == last; });
    };
    if (last && !has_another()) last->withdrawWaiter(this);
    if (listener) listener->offerWaiter(this);
}

engine::ArrivalWaiter::Result ArrivalListeners::wait(const engine::ArrivalListener& listener) {
    switch (link_.wait_for_arrivals(&listener)) {
    case link::ArrivalNotifier::Wait::arrived:
        return ARRIVED;
    case link::ArrivalNotifier::Wait::woken:
        return WOKEN;
    case link::ArrivalNotifier::Wait::refused:
        break;
    }
    return REFUSED;
}

} // namespace tandem::adaptor
