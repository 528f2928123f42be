// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/web/websocket_session.hpp"

namespace tandem::monitor {
namespace {
namespace websocket = boost::beast::websocket;
using WebSocketFailure = boost::beast::error_code;
} // namespace

WebSocketSession::WebSocketSession(boost::beast::tcp_stream stream, Place place, std::chrono::seconds idle,
                                   std::size_t max_message)
    : stream_(std::move(stream)), place_(std::move(place)), received_(max_message) {
    websocket::stream_base::timeout bounds{};
    bounds.handshake_timeout = std::chrono::seconds(5);
    bounds.idle_timeout = idle;
    bounds.keep_alive_pings = true;
    stream_.set_option(bounds);
    stream_.read_message_max(max_message);
}

void WebSocketSession::set_subprotocol(const char* name) {
    stream_.set_option(websocket::stream_base::decorator([name](websocket::response_type& response) {
        response.set(boost::beast::http::field::sec_websocket_protocol, name);
    }));
}

void WebSocketSession::run(Request request) {
    request_ = std::move(request);
    stream_.async_accept(request_, [self = shared_from_this()](WebSocketFailure failure) {
        if (failure) return;
        self->on_open(self->request_);
        self->read();
    });
}

/// The stream handles pings, pongs and the close only while a read is pending.
void WebSocketSession::read() {
    stream_.async_read(received_, [self = shared_from_this()](WebSocketFailure failure, std::size_t) {
        if (failure) return self->close();
        const std::string message = boost::beast::buffers_to_string(self->received_.data());
        self->received_.clear();
        self->on_message(message, self->stream_.got_binary());
        if (boost::beast::get_lowest_layer(self->stream_).socket().is_open()) self->read();
    });
}

void WebSocketSession::send(std::shared_ptr<const std::string> bytes, bool binary) {
    (binary ? queued_binaries_ : queued_texts_) += bytes->size();
    queue_.push_back({std::move(bytes), binary});
    if (queue_.size() == 1) write();
}

void WebSocketSession::write() {
    stream_.binary(queue_.front().binary);
    stream_.async_write(boost::asio::buffer(*queue_.front().bytes),
                        [self = shared_from_this()](WebSocketFailure failure, std::size_t) {
                            if (failure) return self->close();
                            const auto& sent = self->queue_.front();
                            (sent.binary ? self->queued_binaries_ : self->queued_texts_) -=
                                sent.bytes->size();
                            self->queue_.pop_front();
                            if (self->queue_.empty())
                                self->on_sent();
                            else
                                self->write();
                        });
}

void WebSocketSession::close() {
    on_close();
    boost::beast::get_lowest_layer(stream_).close();
}

} // namespace tandem::monitor
