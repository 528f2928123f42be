// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/rt/short_mutex.hpp"

#include <algorithm>
#include <mutex>
#include <vector>

namespace opros {

/// The connections of an output port (Link: IDataPortLink or IEventPortLink), which others own. [any-thread] all
/// functions. One lock guards the list and each walk over it, so that after remove() no push is under way in the
/// removed connection, and several threads that push at the same port deliver one after the other.
template <class Link>
class ConnectionList {
  public:
    /// Does nothing for NULL, and for one that is in the list.
    void add(Link* connection) {
        const std::lock_guard lock(mutex_);
        if (connection &&
            std::find(connections_.begin(), connections_.end(), connection) == connections_.end())
            connections_.push_back(connection);
    }
    void remove(Link* connection) {
        const std::lock_guard lock(mutex_);
        connections_.erase(std::remove(connections_.begin(), connections_.end(), connection),
                           connections_.end());
    }
    void clear() {
        const std::lock_guard lock(mutex_);
        connections_.clear();
    }
    /// In the order in which they were added. `visit` must not change the list: the lock is not recursive. A visit that
    /// only prepares the next one is made by the thread that owns the lock, or not at all (rt::ShortMutex).
    template <class Visit>
    void for_each(Visit visit, bool prepares = false) {
        if (!mutex_.lock_to(prepares)) return;
        const tandem::rt::ShortLock lock(mutex_, std::adopt_lock);
        for (Link* connection : connections_) visit(*connection);
    }

  private:
    tandem::rt::ShortMutex mutex_;
    std::vector<Link*> connections_;
};

} // namespace opros
