// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/web/control_session.hpp"

#include "apps/tandem/monitor/control/control.hpp"

namespace tandem::monitor {

ControlSession::ControlSession(boost::beast::tcp_stream stream, Service& service, Place place)
    : WebSocketSession(std::move(stream), std::move(place), std::chrono::seconds(10), max_message),
      service_(service) {}

void ControlSession::on_message(const std::string& text, bool) {
    if (!trusted_) {
        const auto hello = nlohmann::json::parse(text, nullptr, false);
        trusted_ = hello.is_object() && hello.contains("token") && hello["token"].is_string() &&
                   service_.control->is_token(hello["token"].get<std::string>());
        if (!trusted_) return close();
        return reply(R"({"op":"token","ok":true})");
    }
    // The session can end before a reply.
    service_.control->handle(text, [weak = weak_from_this(), this](const nlohmann::json& result) {
        if (const auto self = weak.lock())
            reply(result.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    });
}

void ControlSession::reply(std::string text) {
    if (queued_messages() >= max_waiting) return close();
    send(std::make_shared<const std::string>(std::move(text)));
}

} // namespace tandem::monitor
