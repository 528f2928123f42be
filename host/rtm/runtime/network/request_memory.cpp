// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/network/request_memory.hpp"

namespace RTC {

bool RequestMemory::has_room(const std::string& client, std::size_t bytes) const {
    const auto found = of_clients_.find(client);
    const std::size_t used = found == of_clients_.end() ? 0 : found->second;
    return used + bytes <= of_client_ && all_ + bytes <= of_all_;
}

bool RequestMemory::take(TakenMemory& taken, const std::string& client, std::size_t bytes,
                         std::chrono::milliseconds longest) {
    std::unique_lock lock(mutex_);
    const auto may_exceed = [&] {
        return taken.bytes > 0 && (exceeding_ == nullptr || exceeding_ == &taken);
    };
    if (!released_.wait_for(lock, longest, [&] { return has_room(client, bytes) || may_exceed(); }))
        return false;
    if (!has_room(client, bytes)) exceeding_ = &taken;
    taken.client = &*of_clients_.try_emplace(client, 0).first;
    taken.client->second += bytes;
    taken.bytes += bytes;
    all_ += bytes;
    return true;
}

void RequestMemory::give_back(TakenMemory& taken) {
    if (taken.bytes == 0) return;
    {
        const std::lock_guard lock(mutex_);
        all_ -= taken.bytes;
        if ((taken.client->second -= taken.bytes) == 0)
            of_clients_.erase(of_clients_.find(taken.client->first));
        if (exceeding_ == &taken) exceeding_ = nullptr;
    }
    released_.notify_all();
    taken = {};
}

} // namespace RTC
