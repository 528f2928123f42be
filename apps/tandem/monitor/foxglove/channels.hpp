// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/state.hpp"
#include "apps/tandem/observe/link_follower.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <nlohmann/json.hpp>

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <tuple>

namespace tandem::monitor {

/// Receives the data of the channels. [one thread]
class ChannelClient {
  public:
    virtual void advertise(const nlohmann::json& channels) = 0; ///< objects of the specification, not empty
    virtual void unadvertise(const std::vector<std::uint32_t>& ids) = 0;
    virtual void graph_changed() = 0;
    virtual void state_changed() {} ///< there is a newer State
    /// `message`: CDR with its encapsulation. `time_ns`: time of reading, since the epoch.
    virtual void message(std::uint32_t channel, std::uint64_t time_ns,
                         std::span<const std::byte> message) = 0;
    virtual bool is_subscribed(std::uint32_t channel) const = 0;
    virtual bool has_subscriptions() const = 0;

  protected:
    ~ChannelClient() = default;
};

/// The data ports of all links as channels `/LINK/PORT` with constant numbers. Follows the links while there are
/// clients. [one thread]
class Channels {
  public:
    /// `state`: returns the newest State, which contains the links. `stop` ends a round early; null: no early end.
    Channels(boost::asio::io_context& context, std::function<const State&()> state,
             const std::atomic<bool>* stop = nullptr)
        : timer_(context), stop_(stop), state_(std::move(state)) {}

    /// Advertises all channels to the client at once.
    void add(ChannelClient& client);
    void remove(ChannelClient& client) { clients_.erase(&client); }
    /// Returns the port of a topic `/LINK/PORT` as last read; nullptr if there is none.
    const command::LinkFollower::Port* find_port(const std::string& topic) const;
    const LinkState* find_link(const std::string& name) const;
    const State& state() const { return state_(); }
    bool is_known(std::uint32_t channel) const { return channels_.count(channel) != 0; }

    /// Returns the specification's connectionGraphUpdate with everything that exists now.
    nlohmann::json graph() const;

  private:
    using Key =
        std::tuple<std::string, shm::Side, std::string, std::string>; ///< link, owner, port, signature

    void look();
    void poll();
    void deliver(const command::LinkFollower::Port& port, const shm::FollowedRecord& record);
    void update_links();
    void update_channels();
    std::uint32_t number_of(const command::LinkFollower::Port& port);
    void tell_all(const std::function<void(ChannelClient&)>& tell);

    boost::asio::steady_timer timer_;
    const std::atomic<bool>* stop_;
    bool looks_ = false;
    std::function<const State&()> state_;
    std::set<ChannelClient*> clients_;
    std::map<std::string, command::LinkFollower> followers_;
    std::string first_;                    ///< link at which the next pass begins
    std::map<Key, std::uint32_t> numbers_; ///< kept when a channel disappears, for its return
    std::map<std::uint32_t, nlohmann::json> channels_;
    std::uint64_t told_ms_ = 0; ///< time of the last State that clients were told about
    std::string graph_;         ///< as last told
    std::vector<std::byte> message_;
};

} // namespace tandem::monitor
