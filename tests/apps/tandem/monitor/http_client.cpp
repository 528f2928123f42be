// SPDX-License-Identifier: Apache-2.0
#include "http_client.hpp"

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <strings.h>

namespace tandem::monitor::test {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using boost::asio::ip::tcp;

std::string Answer::field(const std::string& name) const {
    for (const auto& [key, value] : fields)
        if (strcasecmp(key.c_str(), name.c_str()) == 0) return value;
    return {};
}

struct Connection::Stream {
    asio::io_context context;
    tcp::socket socket{context};
    beast::flat_buffer buffer;
};

Connection::Connection(const RunningMonitor& monitor) : stream_(std::make_unique<Stream>()) {
    stream_->socket.connect({asio::ip::make_address("127.0.0.1"), monitor.port});
}

Connection::~Connection() = default;

void Connection::send(const std::string& bytes) { asio::write(stream_->socket, asio::buffer(bytes)); }

Answer Connection::answer() {
    http::response_parser<http::string_body> parser;
    parser.body_limit(64 << 20);
    beast::error_code failure;
    http::read(stream_->socket, stream_->buffer, parser, failure);
    if (failure) return {};
    const auto& response = parser.get();
    Answer answer{
        response.result_int(), std::string(response[http::field::content_type]), response.body(), {}};
    for (const auto& field : response) answer.fields.emplace_back(field.name_string(), field.value());
    return answer;
}

} // namespace tandem::monitor::test
