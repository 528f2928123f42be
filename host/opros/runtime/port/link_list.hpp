// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <mutex>
#include <vector>

namespace opros {

/// The links of an output port: pushes go through them one after the other, under one lock.
template <class Link>
class LinkList {
  public:
    void add(Link* link) {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (link && std::find(links_.begin(), links_.end(), link) == links_.end()) links_.push_back(link);
    }
    void remove(Link* link) {
        const std::lock_guard<std::mutex> lock(mutex_);
        links_.erase(std::remove(links_.begin(), links_.end(), link), links_.end());
    }
    void clear() {
        const std::lock_guard<std::mutex> lock(mutex_);
        links_.clear();
    }
    template <class Visit>
    void for_each(Visit visit) {
        const std::lock_guard<std::mutex> lock(mutex_);
        for (Link* link : links_) visit(*link);
    }

  private:
    std::mutex mutex_;
    std::vector<Link*> links_;
};

} // namespace opros
