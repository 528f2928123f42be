// SPDX-License-Identifier: Apache-2.0
#include "running_monitor.hpp"

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <nlohmann/json.hpp>

namespace tandem::monitor::test {

namespace asio = boost::asio;
namespace beast = boost::beast;
using boost::asio::ip::tcp;

struct Live::Stream {
    asio::io_context context;
    beast::websocket::stream<tcp::socket, false> socket{context};
};

Live::Live(const RunningMonitor& monitor, int receive_buffer, const std::string& target,
           const std::string& protocol)
    : stream_(std::make_unique<Stream>()) {
    auto& stream = stream_->socket;
    auto& socket = stream.next_layer();
    socket.open(tcp::v4());
    if (receive_buffer != 0) socket.set_option(asio::socket_base::receive_buffer_size(receive_buffer));
    socket.connect({asio::ip::make_address("127.0.0.1"), monitor.port});
    stream.read_message_max(64 << 20);
    stream.set_option(beast::websocket::stream_base::decorator([&](beast::websocket::request_type& request) {
        request.set(beast::http::field::origin, "http://" + monitor.host());
        if (!protocol.empty()) request.set(beast::http::field::sec_websocket_protocol, protocol);
    }));
    stream.handshake(monitor.host(), target);
}

Live::~Live() = default;

nlohmann::json Live::next() {
    beast::flat_buffer buffer;
    stream_->socket.read(buffer);
    return nlohmann::json::parse(beast::buffers_to_string(buffer.data()));
}

void Live::send(const std::string& text) { stream_->socket.write(asio::buffer(text)); }

void Live::send_binary(const std::string& bytes) {
    stream_->socket.binary(true);
    stream_->socket.write(asio::buffer(bytes));
    stream_->socket.binary(false);
}

} // namespace tandem::monitor::test
