// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/rt/short_mutex.hpp"

#include <algorithm>
#include <mutex>
#include <vector>

namespace opros {

/// The connections of an output port (Link: IDataPortLink or IEventPortLink). Does not own them. [any-thread] all
/// functions. One lock guards the list and each iteration. Therefore no push runs in a connection after remove() has
/// returned, and threads that push at the same port deliver one after the other.
template <class Link>
class ConnectionList {
  public:
    /// Does nothing for NULL or for a connection that is already in the list.
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
    /// Visits the connections in the order in which they were added. `visit` must not change the list: the lock is
    /// not recursive. A rehearsal visits none unless the calling thread is the lock's owner (rt::ShortMutex).
    template <class Visit>
    void for_each(Visit visit) {
        if (!mutex_.lock_unless_rehearsing()) return;
        const tandem::rt::ShortLock lock(mutex_, std::adopt_lock);
        for (Link* connection : connections_) visit(*connection);
    }

  private:
    tandem::rt::ShortMutex mutex_;
    std::vector<Link*> connections_;
};

} // namespace opros
