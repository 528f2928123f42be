// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/service/provider_reference.hpp"

namespace tandem::interceptor {

bool ProviderReference::setObject(CORBA::Object_ptr object) {
    if (CORBA::is_nil(object)) return false;
    const std::lock_guard lock(mutex_);
    release_locked();
    kept_.push_back({CORBA::Object::_duplicate(object), Clock::time_point::max()});
    current_.store(kept_.back().object.in(), std::memory_order_release);
    return true;
}

void ProviderReference::releaseObject() {
    const std::lock_guard lock(mutex_);
    release_locked();
}

void ProviderReference::release_locked() {
    const auto now = Clock::now();
    if (!CORBA::is_nil(current_.exchange(CORBA::Object::_nil()))) kept_.back().released_at = now;
    while (!kept_.empty() && kept_.front().released_at < now - longest_call) kept_.pop_front();
}

} // namespace tandem::interceptor
