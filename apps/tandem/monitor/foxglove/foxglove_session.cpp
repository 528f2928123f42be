// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/foxglove/foxglove_session.hpp"

#include "apps/tandem/monitor/control/control.hpp"
#include "apps/tandem/observe/json_message.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstring>

namespace tandem::monitor {
namespace {

using PlainJson = nlohmann::json;

// Ops of binary messages.
constexpr char message_data = 0x01, client_message = 0x01, service_request = 0x02;
constexpr int warning = 1; ///< level of a status

/// Returns the names in `before` that are not in `now`. Both are lists of objects with a name.
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
    : WebSocketSession(std::move(stream), std::move(place), std::chrono::seconds(30), max_message),
      service_(service) {
    set_subprotocol(foxglove_protocol);
}

FoxgloveSession::~FoxgloveSession() {
    if (service_.channels != nullptr) service_.channels->remove(*this);
}

void FoxgloveSession::on_open(const Request& request) {
    PlainJson info{{"op", "serverInfo"},
                   {"name", "tandem monitor"},
                   {"capabilities", {"connectionGraph"}},
                   {"metadata", PlainJson::object()},
                   {"sessionId", service_.session_id}};
    if (service_.control != nullptr && service_.control->is_token(token_of(request))) {
        allow_control();
        info["capabilities"] = {"connectionGraph", "clientPublish", "parameters", "parametersSubscribe",
                                "services"};
        info["supportedEncodings"] = {"cdr", "json"};
    }
    send_json(info);
    service_.channels->add(*this);
}

void FoxgloveSession::allow_control() {
    const ClientLine line{[weak = weak_from_this(), this](const PlainJson& message) {
                              if (const auto self = weak.lock()) send_json(message);
                          },
                          [weak = weak_from_this(), this](std::string bytes) {
                              if (const auto self = weak.lock()) queue(std::move(bytes), true);
                          }};
    Control& control = *service_.control;
    publisher_ = std::make_shared<ClientPublisher>(*service_.channels, control.publishing(), line);
    parameters_ = std::make_shared<ClientParameters>(
        [channels = service_.channels]() -> const State& { return channels->state(); }, control.calling(),
        line);
    services_ = std::make_shared<ClientServices>(control.calling(), line);
}

void FoxgloveSession::state_changed() {
    if (services_ == nullptr) return;
    services_->update(service_.channels->state());
    parameters_->poll();
}

void FoxgloveSession::on_message(const std::string& bytes, bool binary) {
    if (binary)
        on_binary(bytes);
    else
        on_text(bytes);
}

void FoxgloveSession::on_text(const std::string& text) {
    try {
        const PlainJson request = command::parse_json(text);
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
        if (publisher_ != nullptr && control(op, request)) return;
        warn("the monitor is read-only: op " + op.substr(0, 100) + " is not served");
    } catch (const PlainJson::exception&) { // a member has another type
        warn("expected a message of foxglove.websocket.v1");
    } catch (const std::runtime_error& error) {
        warn(std::string("expected a message of foxglove.websocket.v1: ") + error.what());
    }
}

bool FoxgloveSession::control(const std::string& op, const PlainJson& request) {
    if (op == "advertise")
        publisher_->advertise(request.at("channels"));
    else if (op == "unadvertise")
        publisher_->unadvertise(request.at("channelIds"));
    else if (op == "getParameters")
        parameters_->get(request);
    else if (op == "setParameters")
        parameters_->set(request);
    else if (op == "subscribeParameterUpdates")
        parameters_->subscribe(request);
    else if (op == "unsubscribeParameterUpdates")
        parameters_->unsubscribe(request);
    else
        return false;
    return true;
}

void FoxgloveSession::on_binary(const std::string& bytes) {
    if (publisher_ == nullptr)
        return warn("the monitor is read-only: publishing and calling require --control and the token");
    std::uint32_t channel = 0;
    const std::string_view rest = bytes.empty() ? std::string_view() : std::string_view(bytes).substr(1);
    if (!bytes.empty() && bytes[0] == service_request) return services_->call(rest);
    if (bytes.empty() || bytes[0] != client_message || rest.size() < sizeof channel)
        return warn("expected a binary message of foxglove.websocket.v1");
    std::memcpy(&channel, rest.data(), sizeof channel);
    publisher_->message(channel, rest.substr(sizeof channel));
}

void FoxgloveSession::subscribe(const PlainJson& request) {
    for (const auto& subscription : request.at("subscriptions")) {
        const auto id = subscription.at("id").get<std::uint32_t>();
        const auto channel = subscription.at("channelId").get<std::uint32_t>();
        if (!service_.channels->is_known(channel))
            warn(fmt::format("unknown channel {}", channel));
        else if (channel_of_.size() >= max_subscriptions || !channel_of_.emplace(id, channel).second)
            warn(fmt::format("subscription {} already exists, or the limit is reached", id));
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
    send_json({{"op", "advertise"}, {"channels", channels}});
}

void FoxgloveSession::unadvertise(const std::vector<std::uint32_t>& ids) {
    for (const std::uint32_t channel : ids) {
        for (const std::uint32_t id : subscriptions_[channel]) channel_of_.erase(id);
        subscriptions_.erase(channel);
    }
    send_json({{"op", "unadvertise"}, {"channelIds", ids}});
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
    send_json(graph);
    graph_ = std::move(graph);
}

void FoxgloveSession::message(std::uint32_t channel, std::uint64_t time_ns,
                              std::span<const std::byte> message) {
    for (const std::uint32_t id : subscriptions_.at(channel)) {
        if (queued_bytes() + message.size() > max_queued) {
            ++left_out_;
            continue;
        }
        std::string bytes(1 + sizeof id + sizeof time_ns + message.size(), message_data);
        std::memcpy(bytes.data() + 1, &id, sizeof id); // little-endian like this machine
        std::memcpy(bytes.data() + 1 + sizeof id, &time_ns, sizeof time_ns);
        std::memcpy(bytes.data() + 1 + sizeof id + sizeof time_ns, message.data(), message.size());
        queue(std::move(bytes), true);
    }
}

void FoxgloveSession::warn(const std::string& text) {
    send_json({{"op", "status"}, {"level", warning}, {"message", text}});
}

void FoxgloveSession::send_json(const PlainJson& message) {
    queue(message.dump(-1, ' ', false, PlainJson::error_handler_t::replace), false);
}

void FoxgloveSession::queue(std::string bytes, bool binary) {
    if (queued_bytes() + bytes.size() > max_behind) return close();
    send(std::make_shared<const std::string>(std::move(bytes)), binary);
}

void FoxgloveSession::on_sent() {
    if (left_out_ != 0)
        warn(fmt::format("{} messages were dropped because the client reads too slowly",
                         std::exchange(left_out_, 0)));
}

void FoxgloveSession::on_close() { service_.channels->remove(*this); }

} // namespace tandem::monitor
