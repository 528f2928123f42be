// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/web/responses.hpp"
#include "apps/tandem/monitor/web/service.hpp"

#include <boost/beast/core.hpp>

#include <array>
#include <memory>
#include <optional>

namespace tandem::monitor {

/// One connection until its end or its upgrade to a WebSocket. Pending operations keep it alive; each has a time limit.
/// [one thread]
class HttpSession : public std::enable_shared_from_this<HttpSession> {
  public:
    static constexpr std::uint32_t max_header = 8 << 10; ///< bytes

    /// `refuse`: the server is full, and the only answer is 503.
    HttpSession(boost::asio::ip::tcp::socket socket, Service& service, Place place, bool refuse);
    void run() { read(); }

  private:
    void read();
    void on_read(boost::beast::error_code failure);
    template <class Session>
    void become();
    void write(Response response);
    void on_write(boost::beast::error_code failure);
    void drain();

    boost::beast::tcp_stream stream_;
    Service& service_;
    std::optional<Place> place_;
    const bool refuse_;
    boost::beast::flat_buffer buffer_{std::size_t{2} * max_header};
    std::optional<boost::beast::http::request_parser<boost::beast::http::empty_body>> parser_;
    Response response_;
    std::array<char, 4096> drained_{};
    std::size_t drained_bytes_ = 0;
};

} // namespace tandem::monitor
