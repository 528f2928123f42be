// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/foxglove/channels.hpp"

#include "apps/tandem/monitor/round.hpp"
#include "apps/tandem/observe/message_idl.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/record/cdr_message.hpp"
#include "shm/os/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace tandem::monitor {
namespace {

using PlainJson = nlohmann::json;

/// Fast enough for rings of a few hundred messages at 1 kHz. Without subscriptions, it only has to find new ports.
constexpr std::chrono::milliseconds message_pause{20}, channel_pause{200};
/// Limit for the table of numbers, because ports may come and go indefinitely.
constexpr std::size_t max_channels = 10'000;

std::string topic_of(const command::LinkFollower::Port& port) {
    return command::replace_nonprintable(fmt::format("/{}/{}", port.link, port.port.name));
}

std::string host_name(const LinkState& link, shm::Side side) {
    return fmt::format("{} {} {}", link.name, model_of(link, side), link.side(side).program);
}

} // namespace

void Channels::add(ChannelClient& client) {
    clients_.insert(&client);
    if (!looks_) return look(); // it advertises what it finds
    PlainJson all = PlainJson::array();
    for (const auto& [id, channel] : channels_) all.push_back(channel);
    if (!all.empty()) client.advertise(all);
}

void Channels::tell_all(const std::function<void(ChannelClient&)>& tell) {
    const auto clients = clients_; // a copy, because a client may leave meanwhile
    for (ChannelClient* client : clients)
        if (clients_.count(client) != 0) tell(*client);
}

void Channels::look() {
    looks_ = !clients_.empty();
    if (!looks_) {
        followers_.clear();
        channels_.clear();
        graph_.clear();
        return;
    }
    update_links();
    poll();
    update_channels();
    if (auto now = graph().dump(); now != graph_) {
        graph_ = std::move(now);
        tell_all([](ChannelClient& client) { client.graph_changed(); });
    }
    if (std::exchange(told_ms_, state_().time_ms) != state_().time_ms)
        tell_all([](ChannelClient& client) { client.state_changed(); });
    const bool subscribed = std::any_of(clients_.begin(), clients_.end(),
                                        [](const auto* client) { return client->has_subscriptions(); });
    timer_.expires_after(subscribed ? message_pause : channel_pause);
    timer_.async_wait([this](const boost::system::error_code& aborted) {
        if (!aborted) look();
    });
}

void Channels::update_links() {
    std::set<std::string> names;
    for (const LinkState& link : state_().links)
        if (link.readable) names.insert(link.name);
    std::erase_if(followers_, [&](const auto& follower) { return names.count(follower.first) == 0; });
    for (const std::string& name : names) followers_.try_emplace(name, name, std::vector<std::string>{});
}

void Channels::deliver(const command::LinkFollower::Port& port, const shm::FollowedRecord& record) {
    const std::uint32_t id = number_of(port);
    if (channels_.count(id) == 0) return;
    message_.assign(std::begin(command::encapsulation), std::end(command::encapsulation));
    append_message(port, record.bytes, record.stamp, message_);
    const std::uint64_t now = command::wall_clock_ns();
    tell_all([&](ChannelClient& client) {
        if (client.is_subscribed(id)) client.message(id, now, message_);
    });
}

/// Messages beyond a limit are read in the next round, which begins with the link at which this round ends.
void Channels::poll() {
    using command::LinkFollower;
    Round round(stop_);
    std::vector<std::string> order;
    for (auto it = followers_.lower_bound(first_); it != followers_.end(); ++it) order.push_back(it->first);
    for (auto it = followers_.begin(); it != followers_.lower_bound(first_); ++it) order.push_back(it->first);
    first_.clear();
    for (const std::string& name : order) {
        if (round.bytes_left() == 0) {
            first_ = name;
            return;
        }
        const auto count_and_deliver = [&](const LinkFollower::Port& port,
                                           const shm::FollowedRecord& record) {
            round.count_message(record.bytes.size());
            deliver(port, record);
        };
        try {
            followers_.at(name).poll(count_and_deliver, {}, LinkFollower::Rings::likely,
                                     [&] { return round.bytes_left(); });
        } catch (const shm::Error&) { // the link was removed meanwhile
        }
    }
}

std::uint32_t Channels::number_of(const command::LinkFollower::Port& port) {
    const Key key(port.link, port.owner, port.port.name, port.port.signature);
    const auto known = numbers_.find(key);
    if (known != numbers_.end()) return known->second;
    if (numbers_.size() >= max_channels) return 0;
    return numbers_.emplace(key, static_cast<std::uint32_t>(numbers_.size() + 1)).first->second;
}

const command::LinkFollower::Port* Channels::find_port(const std::string& topic) const {
    for (const auto& [name, follower] : followers_)
        for (const auto& port : follower.ports())
            if (topic_of(port) == topic) return &port;
    return nullptr;
}

const LinkState* Channels::find_link(const std::string& name) const {
    for (const LinkState& link : state_().links)
        if (link.name == name) return &link;
    return nullptr;
}

void Channels::update_channels() {
    std::set<std::uint32_t> present;
    PlainJson added = PlainJson::array();
    for (const auto& [name, follower] : followers_)
        for (const auto& port : follower.ports()) {
            const std::uint32_t id = number_of(port);
            if (id == 0 || !present.insert(id).second || channels_.count(id) != 0) continue;
            const auto idl = command::message_idl(port);
            channels_[id] = {{"id", id},           {"topic", topic_of(port)},
                             {"encoding", "cdr"},  {"schemaName", idl.name},
                             {"schema", idl.text}, {"schemaEncoding", "omgidl"}};
            added.push_back(channels_[id]);
        }
    std::vector<std::uint32_t> removed;
    for (const auto& [id, channel] : channels_)
        if (present.count(id) == 0) removed.push_back(id);
    for (const std::uint32_t id : removed) channels_.erase(id);
    if (!removed.empty()) tell_all([&](ChannelClient& client) { client.unadvertise(removed); });
    if (!added.empty()) tell_all([&](ChannelClient& client) { client.advertise(added); });
}

PlainJson Channels::graph() const {
    PlainJson published = PlainJson::array(), subscribed = PlainJson::array(), services = PlainJson::array();
    for (const LinkState& link : state_().links) {
        for (const PortState& port : link.ports) {
            if (!port.damage.empty()) continue;
            const std::string topic = fmt::format("/{}/{}", link.name, port.name);
            published.push_back({{"name", topic}, {"publisherIds", {host_name(link, port.writer)}}});
            subscribed.push_back(
                {{"name", topic}, {"subscriberIds", {host_name(link, shm::other(port.writer))}}});
        }
        for (const SharedPort& port : link.shared_ports)
            if (port.kind == "provided")
                services.push_back({{"name", fmt::format("/{}/{}", link.name, port.name)},
                                    {"providerIds", {host_name(link, port.owner)}}});
    }
    return {{"op", "connectionGraphUpdate"},       {"publishedTopics", published},
            {"subscribedTopics", subscribed},      {"advertisedServices", services},
            {"removedTopics", PlainJson::array()}, {"removedServices", PlainJson::array()}};
}

} // namespace tandem::monitor
