// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <list>
#include <string>

namespace tandem::monitor {

/// A connection in a RequestPool.
class PooledConnection {
  public:
    virtual const std::string& peer_key() const = 0;
    virtual bool waits_for_request() const = 0; ///< false: is answering one
    /// Closes the connection, if possible with an answer. `of_peer`: its peer has too many; false: there are too many in
    /// all.
    virtual void give_way(bool of_peer) = 0;

  protected:
    ~PooledConnection() = default;
};

/// The connections that wait for a request or answer one, without the WebSockets. If there are too many, a new connection
/// replaces one of the peer that has the most, so that slow or silent clients do not block others. [one thread]
class RequestPool {
  public:
    static constexpr std::size_t max_open = 64, max_of_a_peer = 24;

    /// Adds the connection. Another one may have to give way before.
    void add(PooledConnection& connection);
    /// Makes the connection the newest: it waits for its next request, or has begun to answer.
    void renew(PooledConnection& connection);
    /// Does nothing if the connection is not in the pool.
    void remove(PooledConnection& connection) { open_.remove(&connection); }

  private:
    std::size_t count_of(const std::string& peer) const;
    void free_place_of(const std::string& peer, bool of_peer);

    std::list<PooledConnection*> open_; ///< oldest first
};

} // namespace tandem::monitor
