// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/engine/arrival_listener.hpp"
#include "proxy/adaptor/typed/value_type.hpp"

#include <functional>
#include <mutex>
#include <set>
#include <utility>

namespace tandem::adaptor {

/// The connections of a mirror whose messages the link's notifier thread pushes. Listens while a connection with a known
/// type exists; all connections have the same type. `Connection` is the engine's type of a connection. [any-thread]
template <class Connection>
class TypedConnections {
  public:
    /// Sets the listener for arrived messages; nullptr: none. On return the earlier one is not in use.
    using SetListener = std::function<void(engine::ArrivalListener*)>;

    TypedConnections(engine::ArrivalListener& listener, SetListener set_listener)
        : listener_(listener), set_listener_(std::move(set_listener)) {}

    /// Guards the type and the mirror's data about its targets. Must not be held while one of the functions below is
    /// called.
    std::mutex& mutex() const { return mutex_; }
    /// Returns nullptr if the type is unknown. With the mutex held, or in the notifier thread.
    const ValueType* type() const { return type_; }
    /// Returns whether the mirror listens to its channel. Requires the mutex. So does set_type(), which a mirror that
    /// listens must not call.
    bool listens() const { return listens_; }
    void set_type(const ValueType* type) { type_ = type; }

    /// Sets the listener if there are connections of a known type. Engines check a target before or after they add it: call
    /// this after the check. add() calls it as well.
    void listen_if_connected() {
        {
            const std::lock_guard lock(mutex_);
            if (listens_ || !type_ || connections_.empty()) return;
            listens_ = true;
        }
        set_listener_(&listener_);
    }

    void add(Connection* connection) {
        {
            const std::lock_guard lock(mutex_);
            connections_.insert(connection);
        }
        listen_if_connected();
    }

    void remove(Connection* connection) {
        bool is_last = false;
        {
            const std::lock_guard lock(mutex_);
            is_last = connections_.erase(connection) == 1 && connections_.empty() && listens_;
        }
        if (is_last) stop_listening();
    }

    void clear() {
        bool listened = false;
        {
            const std::lock_guard lock(mutex_);
            connections_.clear();
            listened = listens_;
        }
        if (listened) stop_listening();
    }

  private:
    /// Removes the listener first, which waits for the notifier thread.
    void stop_listening() {
        set_listener_(nullptr);
        const std::lock_guard lock(mutex_);
        listens_ = false;
        type_ = nullptr;
    }

    engine::ArrivalListener& listener_;
    const SetListener set_listener_;
    mutable std::mutex mutex_;
    std::set<Connection*> connections_;
    const ValueType* type_ = nullptr;
    bool listens_ = false;
};

} // namespace tandem::adaptor
