// SPDX-License-Identifier: Apache-2.0
// Which client gets a place at the monitor, tested without connections. clients_test.cpp uses connections.
#include "apps/tandem/monitor/web/places.hpp"
#include "apps/tandem/monitor/web/request_pool.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <deque>
#include <vector>

using namespace tandem::monitor;

namespace {

/// Takes places until none is left. Returns those taken.
std::vector<Place> take_all(Places& places, const std::string& peer, bool has_token = false) {
    std::vector<Place> taken;
    while (auto place = places.take(peer, has_token)) taken.push_back(std::move(*place));
    return taken;
}

/// A connection that notes how it ends.
struct Client final : PooledConnection {
    Client(std::string of_peer, bool waiting = true) : peer(std::move(of_peer)), waits(waiting) {}
    const std::string& peer_key() const override { return peer; }
    bool waits_for_request() const override { return waits; }
    void give_way(bool of_peer) override {
        gone = true;
        gone_for_peer = of_peer;
    }
    std::string peer;
    bool waits, gone = false, gone_for_peer = false;
};

/// Adds as many connections of the peer as it may have.
void fill(RequestPool& pool, std::deque<Client>& clients, const std::string& peer) {
    for (std::size_t i = 0; i < RequestPool::max_of_a_peer; ++i) pool.add(clients.emplace_back(peer));
}

std::size_t gone(const std::deque<Client>& clients) {
    return static_cast<std::size_t>(
        std::count_if(clients.begin(), clients.end(), [](const Client& client) { return client.gone; }));
}

} // namespace

TEST_CASE("no peer takes all places of WebSockets") {
    Places places;
    const auto first = take_all(places, "user 1");
    CHECK(first.size() == Places::max_of_a_peer);
    CHECK(places.is_peer_full("user 1"));
    CHECK_FALSE(places.is_peer_full("user 2"));
    CHECK(places.take("user 2", false));
}

TEST_CASE("many peers together take all places but the reserved ones") {
    Places places;
    std::vector<std::vector<Place>> taken;
    std::size_t count = 0;
    for (int i = 0; i < 10; ++i) count += taken.emplace_back(take_all(places, std::to_string(i))).size();
    CHECK(count == Places::max_open);
    CHECK_FALSE(places.take("me", false));
    CHECK(take_all(places, "me", true).size() == Places::reserved);
    taken.clear();
    CHECK(take_all(places, "me").size() == Places::max_of_a_peer);
}

TEST_CASE("a peer with all its places gets the reserved ones with the token") {
    Places places;
    const auto own = take_all(places, "me");
    CHECK_FALSE(places.take("me", false));
    {
        const auto with_token = take_all(places, "me", true);
        CHECK(with_token.size() == Places::reserved);
        CHECK_FALSE(places.take("me", true));
    }
    CHECK(places.take("me", true));
}

TEST_CASE("the peer with the most requests gives way to a new one, its oldest first") {
    RequestPool pool;
    std::deque<Client> clients;
    fill(pool, clients, "a");
    fill(pool, clients, "b");
    while (clients.size() < RequestPool::max_open) pool.add(clients.emplace_back("c"));
    CHECK(gone(clients) == 0);
    pool.renew(clients[0]); // it has sent a request meanwhile
    Client me("me");
    pool.add(me);
    CHECK(gone(clients) == 1);
    CHECK(clients[1].gone);
    CHECK_FALSE(clients[1].gone_for_peer);
    CHECK_FALSE(me.gone);
}

TEST_CASE("a peer with too many requests loses its own oldest one") {
    RequestPool pool;
    std::deque<Client> clients;
    Client other("b");
    pool.add(other);
    fill(pool, clients, "a");
    pool.add(clients.emplace_back("a"));
    CHECK(gone(clients) == 1);
    CHECK(clients[0].gone);
    CHECK(clients[0].gone_for_peer);
    CHECK_FALSE(other.gone);
}

TEST_CASE("a connection that waits for a request gives way before one that is being answered") {
    RequestPool pool;
    std::deque<Client> clients;
    pool.add(clients.emplace_back("a", false));
    while (clients.size() < RequestPool::max_of_a_peer) pool.add(clients.emplace_back("a"));
    pool.add(clients.emplace_back("a"));
    CHECK_FALSE(clients[0].gone);
    CHECK(clients[1].gone);
    for (Client& client : clients) pool.remove(client);
    pool.remove(clients[0]); // once more
}
