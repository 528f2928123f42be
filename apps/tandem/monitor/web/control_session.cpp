// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/web/control_session.hpp"

#include "apps/tandem/monitor/control/control.hpp"
#include "apps/tandem/monitor/web/websocket_bounds.hpp"

#include <chrono>

namespace tandem::monitor {
namespace {
using ControlFailure = boost::beast::error_code;
} // namespace

ControlSession::ControlSession(boost::beast::tcp_stream stream, Service& service, Place place)
    : stream_(std::move(stream)), service_(service), place_(std::move(place)) {
    set_bounds(stream_, std::chrono::seconds(10), max_message);
    stream_.text(true);
}

void ControlSession::run(Request request) {
    request_ = std::move(request);
    stream_.async_accept(request_, [self = shared_from_this()](ControlFailure failure) {
        if (!failure) self->read();
    });
}

void ControlSession::read() {
    stream_.async_read(received_, [self = shared_from_this()](ControlFailure failure, std::size_t) {
        if (failure) return self->close();
        const std::string text = boost::beast::buffers_to_string(self->received_.data());
        self->received_.clear();
        self->on_message(text);
        if (boost::beast::get_lowest_layer(self->stream_).socket().is_open()) self->read();
    });
}

void ControlSession::on_message(const std::string& text) {
    if (!trusted_) {
        const auto hello = nlohmann::json::parse(text, nullptr, false);
        trusted_ = hello.is_object() && hello.contains("token") && hello["token"].is_string() &&
                   service_.control->is_token(hello["token"].get<std::string>());
        if (!trusted_) return close();
        return send(R"({"op":"token","ok":true})");
    }
    // The session may have ended when a reply comes.
    service_.control->handle(text, [weak = weak_from_this()](const nlohmann::json& reply) {
        if (const auto self = weak.lock())
            self->send(reply.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    });
}

void ControlSession::send(std::string text) {
    if (replies_.size() >= max_waiting) return close();
    replies_.push_back(std::move(text));
    if (replies_.size() == 1) write();
}

void ControlSession::write() {
    stream_.async_write(boost::asio::buffer(replies_.front()),
                        [self = shared_from_this()](ControlFailure failure, std::size_t) {
                            if (failure) return self->close();
                            self->replies_.pop_front();
                            if (!self->replies_.empty()) self->write();
                        });
}

void ControlSession::close() { boost::beast::get_lowest_layer(stream_).close(); }

} // namespace tandem::monitor
