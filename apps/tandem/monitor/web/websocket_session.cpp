// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/web/websocket_session.hpp"

#include "apps/tandem/monitor/web/websocket_bounds.hpp"

#include <chrono>

namespace tandem::monitor {
namespace {
using WebSocketFailure = boost::beast::error_code;
} // namespace

WebSocketSession::WebSocketSession(boost::beast::tcp_stream stream, Service& service, Place place)
    : stream_(std::move(stream)), service_(service), place_(std::move(place)) {
    set_bounds(stream_, std::chrono::seconds(30), max_message);
    stream_.text(true);
}

WebSocketSession::~WebSocketSession() { service_.live.erase(this); }

void WebSocketSession::run(Request request) {
    request_ = std::move(request);
    stream_.async_accept(request_,
                         [self = shared_from_this()](WebSocketFailure failure) { self->on_accept(failure); });
}

void WebSocketSession::on_accept(WebSocketFailure failure) {
    if (failure) return;
    service_.live.insert(this);
    send(service_.state);
    read();
}

/// Pings, pongs and the close are handled only while a read is under way.
void WebSocketSession::read() {
    stream_.async_read(received_, [self = shared_from_this()](WebSocketFailure failure, std::size_t) {
        self->received_.clear();
        if (!failure) return self->read();
        // No more states for it: a write that is under way ends with the connection.
        self->service_.live.erase(self.get());
        boost::beast::get_lowest_layer(self->stream_).close();
    });
}

void WebSocketSession::send(std::shared_ptr<const std::string> state) {
    next_ = std::move(state);
    if (sending_ == nullptr) return write();
    if (++skipped_ >= max_skipped) boost::beast::get_lowest_layer(stream_).close(); // ends both operations
}

void WebSocketSession::write() {
    sending_ = std::move(next_);
    next_ = nullptr;
    stream_.async_write(
        boost::asio::buffer(*sending_),
        [self = shared_from_this()](WebSocketFailure failure, std::size_t) { self->on_write(failure); });
}

void WebSocketSession::on_write(WebSocketFailure failure) {
    sending_ = nullptr;
    skipped_ = 0;
    if (!failure && next_ != nullptr) write();
}

} // namespace tandem::monitor
