// SPDX-License-Identifier: Apache-2.0
// `tandem monitor` as a child process, and its clients.
#pragma once
#include "proxy/link/protocol/port_table.hpp"
#include "proxy/link/session/link_session.hpp"
#include "tests/apps/tandem/program.hpp"

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include <algorithm>
#include <fstream>
#include <memory>
#include <unistd.h>

namespace tandem::monitor::test {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using boost::asio::ip::tcp;

/// The program, showing one link, at a port that the kernel has chosen.
class RunningMonitor {
  public:
    /// `more`: one more option, if not empty.
    explicit RunningMonitor(const std::string& link, const std::string& more = "") {
        int ends[2];
        REQUIRE(pipe(ends) == 0);
        child_ = std::make_unique<shm::test::Child>([&] {
            dup2(ends[1], 1);
            ::close(ends[0]);
            ::close(ends[1]);
            execl(TANDEM_PROGRAM, TANDEM_PROGRAM, "monitor", link.c_str(), "--port", "0",
                  more.empty() ? nullptr : more.c_str(), static_cast<char*>(nullptr));
            return 98;
        });
        ::close(ends[1]);
        std::string url;
        for (char c = 0; read(ends[0], &c, 1) == 1 && c != '\n';) url += c;
        ::close(ends[0]);
        INFO(url);
        REQUIRE(url.rfind("http://127.0.0.1:", 0) == 0);
        port = static_cast<std::uint16_t>(std::stoi(url.substr(url.rfind(':') + 1)));
        if (const auto at = url.find("#token="); at != std::string::npos) token = url.substr(at + 7);
    }
    std::string host() const { return "127.0.0.1:" + std::to_string(port); }
    tcp::endpoint endpoint() const { return {asio::ip::make_address("127.0.0.1"), port}; }
    bool runs() { return !child_->ended(); }
    /// Memory that the process has used at most, kB.
    long peak_kb() const {
        std::ifstream file("/proc/" + std::to_string(child_->pid()) + "/status");
        for (std::string word; file >> word;)
            if (word == "VmHWM:") return file >> word, std::stol(word);
        return -1;
    }

    std::uint16_t port = 0;
    std::string token; ///< with --control

  private:
    std::unique_ptr<shm::test::Child> child_;
};

struct Answer {
    unsigned status = 0;
    std::string type, body;
    http::fields fields;
};

/// A connection on which bytes are sent as they are.
class Connection {
  public:
    explicit Connection(const RunningMonitor& monitor) : socket_(context_) {
        socket_.connect(monitor.endpoint());
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

/// A page's WebSocket. `receive_buffer`: bytes that the kernel keeps for it, 0: as many as it likes.
class Live {
  public:
    explicit Live(const RunningMonitor& monitor, int receive_buffer = 0,
                  const std::string& target = "/api/live", const std::string& protocol = "")
        : stream_(context_) {
        auto& socket = stream_.next_layer();
        socket.open(tcp::v4());
        if (receive_buffer != 0) socket.set_option(asio::socket_base::receive_buffer_size(receive_buffer));
        socket.connect(monitor.endpoint());
        stream_.read_message_max(64 << 20);
        stream_.set_option(
            beast::websocket::stream_base::decorator([&](beast::websocket::request_type& request) {
                request.set(http::field::origin, "http://" + monitor.host());
                if (!protocol.empty()) request.set(http::field::sec_websocket_protocol, protocol);
            }));
        stream_.handshake(monitor.host(), target);
    }
    nlohmann::json next() {
        beast::flat_buffer buffer;
        stream_.read(buffer);
        return nlohmann::json::parse(beast::buffers_to_string(buffer.data()));
    }
    void send(const std::string& text) { stream_.write(asio::buffer(text)); }
    void send_binary(const std::string& bytes) {
        stream_.binary(true);
        stream_.write(asio::buffer(bytes));
        stream_.binary(false);
    }

  private:
    asio::io_context context_;
    beast::websocket::stream<tcp::socket> stream_;
};

/// Publishes data ports of these names and signatures, whose messages the first side sends. Returns their rings.
inline std::vector<shm::RingHandle> add_ports(shm::Segment& first, const std::vector<std::string>& names,
                                              const std::string& signature = "d") {
    link::PortTable table;
    std::vector<shm::RingHandle> rings;
    table.components.push_back({"Plant"});
    for (const auto& name : names) {
        link::Port port;
        port.kind = link::PortKind::data_out;
        port.name = name;
        port.type = "Number";
        port.signature = signature;
        port.component = "Plant";
        table.ports.push_back(port);
        rings.push_back(first.add_ring(link::ring_name(name), {.max_record = 100, .capacity = 4096}));
    }
    const auto bytes = link::encode(table);
    link::write_published_table(
        first.add_blob(link::table_name, link::published_table_bytes(bytes.size(), false)), bytes, 1);
    first.publish();
    return rings;
}

} // namespace tandem::monitor::test
