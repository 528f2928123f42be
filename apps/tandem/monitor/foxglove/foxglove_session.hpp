// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/foxglove/channels.hpp"
#include "apps/tandem/monitor/foxglove/client_parameters.hpp"
#include "apps/tandem/monitor/foxglove/client_publisher.hpp"
#include "apps/tandem/monitor/foxglove/client_services.hpp"
#include "apps/tandem/monitor/web/websocket_session.hpp"

#include <map>
#include <memory>
#include <set>
#include <string>

namespace tandem::monitor {

/// The subprotocol's name in the header Sec-WebSocket-Protocol.
inline constexpr const char* foxglove_protocol = "foxglove.websocket.v1";
/// Returns whether the request asks for the subprotocol.
bool asks_for_foxglove(const Request& request);

/// A client that uses foxglove.websocket.v1. Without the token, it is read-only. With the token in its address
/// (`/?token=...`), it may publish, set parameters and call services. [one thread]
class FoxgloveSession final : public WebSocketSession, private ChannelClient {
  public:
    static constexpr std::size_t max_message = 256 << 10; ///< bytes of a client's message
    static constexpr std::size_t max_subscriptions = 10'000;
    static constexpr std::size_t max_queued = 8 << 20;  ///< bytes; messages that do not fit are dropped
    static constexpr std::size_t max_behind = 16 << 20; ///< queued bytes at which the client is disconnected

    FoxgloveSession(boost::beast::tcp_stream stream, Service& service, Place place);
    ~FoxgloveSession() override;

  private:
    void advertise(const nlohmann::json& channels) override;
    void unadvertise(const std::vector<std::uint32_t>& ids) override;
    void graph_changed() override;
    void state_changed() override;
    void message(std::uint32_t channel, std::uint64_t time_ns, std::span<const std::byte> message) override;
    bool is_subscribed(std::uint32_t channel) const override { return subscriptions_.count(channel) != 0; }
    bool has_subscriptions() const override { return !subscriptions_.empty(); }

    void on_open(const Request& request) override;
    void on_message(const std::string& bytes, bool binary) override;
    void on_sent() override;
    void on_close() override;

    void on_text(const std::string& text);
    void on_binary(const std::string& bytes);
    bool control(const std::string& op, const nlohmann::json& request);
    void allow_control();
    void subscribe(const nlohmann::json& request);
    void unsubscribe(const nlohmann::json& request);
    void warn(const std::string& text);
    void send_graph();
    void send_json(const nlohmann::json& message);
    void queue(std::string bytes, bool binary);

    Service& service_;
    std::uint64_t left_out_ = 0; ///< dropped messages since the last warning
    std::map<std::uint32_t, std::set<std::uint32_t>> subscriptions_; ///< subscription numbers by channel
    std::map<std::uint32_t, std::uint32_t> channel_of_;              ///< by subscription number
    /// Only with the token. They end with the session; later answers are discarded.
    std::shared_ptr<ClientPublisher> publisher_;
    std::shared_ptr<ClientParameters> parameters_;
    std::shared_ptr<ClientServices> services_;
    bool wants_graph_ = false;
    nlohmann::json graph_; ///< as last sent
};

} // namespace tandem::monitor
