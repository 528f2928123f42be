// SPDX-License-Identifier: Apache-2.0
// A client of the HTTP server of `tandem monitor`.
#pragma once
#include "running_monitor.hpp"

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <nlohmann/json.hpp>

namespace tandem::monitor::test {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using boost::asio::ip::tcp;

inline tcp::endpoint endpoint(const RunningMonitor& monitor) {
    return {asio::ip::make_address("127.0.0.1"), monitor.port};
}

struct Answer {
    unsigned status = 0;
    std::string type, body;
    http::fields fields;
};

/// A connection on which bytes are sent as they are.
class Connection {
  public:
    explicit Connection(const RunningMonitor& monitor) : socket_(context_) {
        socket_.connect(endpoint(monitor));
    }
    void send(const std::string& bytes) { asio::write(socket_, asio::buffer(bytes)); }
    /// Status 0: the server has closed without an answer.
    Answer answer() {
        http::response_parser<http::string_body> parser;
        parser.body_limit(64 << 20);
        beast::error_code failure;
        http::read(socket_, buffer_, parser, failure);
        if (failure) return {};
        const auto& response = parser.get();
        return {response.result_int(), std::string(response[http::field::content_type]), response.body(),
                response.base()};
    }

  private:
    asio::io_context context_;
    tcp::socket socket_;
    beast::flat_buffer buffer_;
};

inline Answer get(const RunningMonitor& monitor, const std::string& target, const std::string& method = "GET",
                  const std::string& more = "") {
    Connection connection(monitor);
    connection.send(method + " " + target + " HTTP/1.1\r\nHost: " + monitor.host() + "\r\n" + more + "\r\n");
    return connection.answer();
}

inline nlohmann::json state(const RunningMonitor& monitor) {
    return nlohmann::json::parse(get(monitor, "/api/state").body);
}

} // namespace tandem::monitor::test
