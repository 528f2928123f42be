// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/web/server.hpp"

#include "apps/tandem/monitor/web/http_session.hpp"
#include "apps/tandem/monitor/web/page_session.hpp"

#include <fmt/format.h>

#include <chrono>
#include <stdexcept>
#include <vector>

namespace tandem::monitor {
namespace {

using boost::asio::ip::tcp;
using ErrorCode = boost::system::error_code;

/// Kernel buffer in bytes for data that a slow client has not read.
constexpr int send_buffer = 256 << 10;
/// Connections that the kernel keeps until the server accepts them.
constexpr int max_pending = 128;
/// Pause after accept fails, usually because of too many open files.
constexpr std::chrono::milliseconds accept_pause{200};

} // namespace

Server::Server(boost::asio::io_context& context, const std::string& address, std::uint16_t port,
               Service& service)
    : acceptor_(context), retry_(context), service_(service) {
    ErrorCode failure;
    const auto ip = boost::asio::ip::make_address(address, failure);
    if (failure)
        throw std::runtime_error(
            fmt::format("--bind {}: expected an address such as 127.0.0.1 or ::1", address));
    service_.loopback = ip.is_loopback();
    const tcp::endpoint endpoint(ip, port);
    acceptor_.open(endpoint.protocol(), failure);
    // Allows binding while connections of an earlier monitor are still closing.
    if (!failure) acceptor_.set_option(boost::asio::socket_base::reuse_address(true), failure);
    if (!failure) acceptor_.bind(endpoint, failure);
    if (!failure) acceptor_.listen(max_pending, failure);
    if (failure)
        throw std::runtime_error(fmt::format("cannot listen at {}, port {}: {}; {}", address, port,
                                             failure.message(),
                                             failure == boost::asio::error::address_in_use
                                                 ? "end the program that uses it, or choose another --port"
                                                 : "choose another --bind or --port"));
    accept();
}

std::string Server::url() const {
    const auto endpoint = acceptor_.local_endpoint();
    auto address = endpoint.address();
    // No client can address 0.0.0.0 or ::, which mean all addresses of this machine.
    if (address.is_unspecified())
        address = boost::asio::ip::make_address(address.is_v6() ? "::1" : "127.0.0.1");
    const std::string number = address.to_string();
    return fmt::format("http://{}:{}/", address.is_v6() ? "[" + number + "]" : number, endpoint.port());
}

void Server::publish() {
    // A copy, because a session may leave the set during its send.
    const std::vector<PageSession*> live(service_.live.begin(), service_.live.end());
    for (PageSession* session : live)
        if (service_.live.count(session) != 0) session->send_state(service_.state);
}

void Server::accept() {
    acceptor_.async_accept([this](const ErrorCode& failure, tcp::socket socket) {
        if (failure == boost::asio::error::operation_aborted) return;
        if (failure) {
            retry_.expires_after(accept_pause);
            return retry_.async_wait([this](const ErrorCode& aborted) {
                if (!aborted) accept();
            });
        }
        accept();
        serve(std::move(socket));
    });
}

void Server::serve(tcp::socket socket) {
    ErrorCode ignored; // the client may be gone
    socket.set_option(boost::asio::socket_base::send_buffer_size(send_buffer), ignored);
    std::make_shared<HttpSession>(std::move(socket), service_)->run();
}

} // namespace tandem::monitor
