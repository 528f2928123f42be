// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <mutex>
#include <vector>

namespace opros {

/// The links of an output port: pushes go through them one after the other, under one lock.
template <class Link>
class ConnectionList {
  public:
    void add(Link* link) {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (link && std::find(connections_.begin(), connections_.end(), link) == connections_.end())
            connections_.push_back(link);
    }
    void remove(Link* link) {
        const std::lock_guard<std::mutex> lock(mutex_);
        connections_.erase(std::remove(connections_.begin(), connections_.end(), link), connections_.end());
    }
    void clear() {
        const std::lock_guard<std::mutex> lock(mutex_);
        connections_.clear();
    }
    template <class Visit>
    void for_each(Visit visit) {
        const std::lock_guard<std::mutex> lock(mutex_);
        for (Link* link : connections_) visit(*link);
    }

  private:
    std::mutex mutex_;
    std::vector<Link*> connections_;
};

} // namespace opros
