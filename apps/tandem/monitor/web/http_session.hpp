// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/web/peer.hpp"
#include "apps/tandem/monitor/web/responses.hpp"
#include "apps/tandem/monitor/web/service.hpp"

#include <boost/beast/core.hpp>

#include <array>
#include <memory>
#include <optional>

namespace tandem::monitor {

/// One connection until its end or its upgrade to a WebSocket. Pending operations keep it alive; each has a time limit.
/// [one thread]
class HttpSession final : public std::enable_shared_from_this<HttpSession>, private PooledConnection {
  public:
    static constexpr std::uint32_t max_header = 8 << 10; ///< bytes

    HttpSession(boost::asio::ip::tcp::socket socket, Service& service);
    ~HttpSession() { service_.requests.remove(*this); }
    HttpSession(const HttpSession&) = delete;
    HttpSession& operator=(const HttpSession&) = delete;
    /// Joins the service's pool of requests, and reads.
    void run();

  private:
    const std::string& peer_key() const override { return peer_.key; }
    bool waits_for_request() const override { return reading_; }
    void give_way(bool of_peer) override;

    void read();
    void on_read(boost::beast::error_code failure);
    void answer(const Request& request);
    void upgrade(const Request& request);
    template <class Session>
    void become(bool has_token);
    void refuse(boost::beast::http::status code, const std::string& line);
    void log_refusal(const std::string& line);
    void send_recording(const Request& request);
    void write(Response response);
    void on_write(boost::beast::error_code failure);
    void drain();

    boost::beast::tcp_stream stream_;
    Service& service_;
    const Peer peer_;
    const boost::asio::ip::address local_; ///< this end of the connection
    bool reading_ = false;                 ///< no answer has begun
    boost::beast::flat_buffer buffer_{std::size_t{2} * max_header};
    std::optional<boost::beast::http::request_parser<boost::beast::http::empty_body>> parser_;
    Response response_;
    std::array<char, 4096> drained_{};
    std::size_t drained_bytes_ = 0;
};

} // namespace tandem::monitor
