// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/foxglove/foxglove_session.hpp"

#include "apps/tandem/monitor/web/websocket_bounds.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstring>

namespace tandem::monitor {
namespace {

using PlainJson = nlohmann::json;
using FoxgloveFailure = boost::beast::error_code;
namespace websocket = boost::beast::websocket;

constexpr char message_data = 0x01; ///< op of a binary message
constexpr int warning = 1;          ///< level of a status

/// Names in `before` that are not in `now`, lists of objects with a name.
PlainJson removed_names(const PlainJson& before, const PlainJson& now) {
    std::set<std::string> present;
    for (const auto& item : now) present.insert(item.at("name").get<std::string>());
    PlainJson removed = PlainJson::array();
    for (const auto& item : before)
        if (present.count(item.at("name").get<std::string>()) == 0) removed.push_back(item.at("name"));
    return removed;
}

} // namespace

bool asks_for_foxglove(const Request& request) {
    const auto names = request[boost::beast::http::field::sec_websocket_protocol];
    return boost::beast::http::token_list(names).exists(foxglove_protocol);
}

FoxgloveSession::FoxgloveSession(boost::beast::tcp_stream stream, Service& service, Place place)
    : stream_(std::move(stream)), service_(service), place_(std::move(place)) {
    set_bounds(stream_, std::chrono::seconds(30), max_message);
    stream_.set_option(websocket::stream_base::decorator([](websocket::response_type& response) {
        response.set(boost::beast::http::field::sec_websocket_protocol, foxglove_protocol);
    }));
}

FoxgloveSession::~FoxgloveSession() { service_.channels->remove(*this); }

void FoxgloveSession::run(Request request) {
    request_ = std::move(request);
    stream_.async_accept(request_,
                         [self = shared_from_this()](FoxgloveFailure failure) { self->on_accept(failure); });
}

void FoxgloveSession::on_accept(FoxgloveFailure failure) {
    if (failure) return;
    send({{"op", "serverInfo"},
          {"name", "tandem monitor"},
          {"capabilities", {"connectionGraph"}},
          {"metadata", PlainJson::object()},
          {"sessionId", service_.session_id}});
    service_.channels->add(*this);
    read();
}

void FoxgloveSession::read() {
    stream_.async_read(received_, [self = shared_from_this()](FoxgloveFailure failure, std::size_t) {
        if (failure) return self->close();
        const std::string text = boost::beast::buffers_to_string(self->received_.data());
        self->received_.clear();
        if (self->stream_.got_text())
            self->on_message(text);
        else
            self->warn("the monitor only shows: nothing may be published or called");
        if (boost::beast::get_lowest_layer(self->stream_).socket().is_open()) self->read();
    });
}

void FoxgloveSession::on_message(const std::string& text) {
    const PlainJson request = PlainJson::parse(text, nullptr, false);
    try {
        const auto op = request.at("op").get<std::string>();
        if (op == "subscribe") return subscribe(request);
        if (op == "unsubscribe") return unsubscribe(request);
        if (op == "subscribeConnectionGraph") {
            wants_graph_ = true;
            graph_ = nullptr;
            return send_graph();
        }
        if (op == "unsubscribeConnectionGraph") {
            wants_graph_ = false;
            return;
        }
        warn("the monitor only shows: op " + op.substr(0, 100) + " is not served");
    } catch (const PlainJson::exception&) {
        warn("a message of foxglove.websocket.v1 was expected");
    }
}

void FoxgloveSession::subscribe(const PlainJson& request) {
    for (const auto& subscription : request.at("subscriptions")) {
        const auto id = subscription.at("id").get<std::uint32_t>();
        const auto channel = subscription.at("channelId").get<std::uint32_t>();
        if (!service_.channels->is_known(channel))
            warn(fmt::format("there is no channel {}", channel));
        else if (channel_of_.size() >= max_subscriptions || !channel_of_.emplace(id, channel).second)
            warn(fmt::format("subscription {} is there already, or there are too many", id));
        else
            subscriptions_[channel].insert(id);
    }
}

void FoxgloveSession::unsubscribe(const PlainJson& request) {
    for (const auto& number : request.at("subscriptionIds")) {
        const auto found = channel_of_.find(number.get<std::uint32_t>());
        if (found == channel_of_.end()) continue;
        auto& ids = subscriptions_[found->second];
        ids.erase(found->first);
        if (ids.empty()) subscriptions_.erase(found->second);
        channel_of_.erase(found);
    }
}

void FoxgloveSession::advertise(const PlainJson& channels) {
    send({{"op", "advertise"}, {"channels", channels}});
}

void FoxgloveSession::unadvertise(const std::vector<std::uint32_t>& ids) {
    for (const std::uint32_t channel : ids) {
        for (const std::uint32_t id : subscriptions_[channel]) channel_of_.erase(id);
        subscriptions_.erase(channel);
    }
    send({{"op", "unadvertise"}, {"channelIds", ids}});
}

void FoxgloveSession::graph_changed() {
    if (wants_graph_) send_graph();
}

void FoxgloveSession::send_graph() {
    PlainJson graph = service_.channels->graph();
    if (!graph_.is_null()) {
        graph["removedTopics"] = removed_names(graph_["publishedTopics"], graph["publishedTopics"]);
        graph["removedServices"] = removed_names(graph_["advertisedServices"], graph["advertisedServices"]);
    }
    send(graph);
    graph_ = std::move(graph);
}

void FoxgloveSession::message(std::uint32_t channel, std::uint64_t time_ns,
                              std::span<const std::byte> message) {
    for (const std::uint32_t id : subscriptions_.at(channel)) {
        if (queued_ + message.size() > max_queued) {
            ++left_out_;
            continue;
        }
        std::string bytes(1 + sizeof id + sizeof time_ns + message.size(), message_data);
        std::memcpy(bytes.data() + 1, &id, sizeof id); // little endian, as this machine
        std::memcpy(bytes.data() + 1 + sizeof id, &time_ns, sizeof time_ns);
        std::memcpy(bytes.data() + 1 + sizeof id + sizeof time_ns, message.data(), message.size());
        queue({true, std::move(bytes)});
    }
}

void FoxgloveSession::warn(const std::string& text) {
    send({{"op", "status"}, {"level", warning}, {"message", text}});
}

void FoxgloveSession::send(const PlainJson& message) {
    queue({false, message.dump(-1, ' ', false, PlainJson::error_handler_t::replace)});
}

void FoxgloveSession::queue(Outgoing outgoing) {
    queued_ += outgoing.bytes.size();
    if (queued_ > max_behind) return close();
    queue_.push_back(std::move(outgoing));
    if (queue_.size() == 1) write();
}

void FoxgloveSession::write() {
    stream_.binary(queue_.front().binary);
    stream_.async_write(boost::asio::buffer(queue_.front().bytes), [self = shared_from_this()](
                                                                       FoxgloveFailure failure, std::size_t) {
        if (failure) return self->close();
        self->queued_ -= self->queue_.front().bytes.size();
        self->queue_.pop_front();
        if (self->left_out_ != 0 && self->queue_.empty())
            self->warn(fmt::format("{} messages were left out: the client reads too slowly",
                                   std::exchange(self->left_out_, 0)));
        else if (!self->queue_.empty())
            self->write();
    });
}

void FoxgloveSession::close() {
    service_.channels->remove(*this);
    boost::beast::get_lowest_layer(stream_).close();
}

} // namespace tandem::monitor
