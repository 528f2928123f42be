// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/web/http_session.hpp"

#include "apps/tandem/monitor/control/control.hpp"
#include "apps/tandem/monitor/foxglove/foxglove_session.hpp"
#include "apps/tandem/monitor/web/page_session.hpp"
#include "apps/tandem/monitor/web/websocket_session.hpp"

#include <boost/beast/websocket/rfc6455.hpp>
#include <chrono>
#include <string>

namespace tandem::monitor {
namespace {

/// A client of the control. It first sends the token; each further message is a request of Control. [one thread]
class ControlSession final : public WebSocketSession {
  public:
    static constexpr std::size_t max_message = 8 << 10; ///< bytes of a request
    static constexpr std::size_t max_waiting = 32;      ///< limit for unsent replies

    ControlSession(boost::beast::tcp_stream stream, Service& service, Place place)
        : WebSocketSession(std::move(stream), std::move(place), std::chrono::seconds(10), max_message),
          service_(service) {}

  private:
    void on_open(const Request&) override {}
    void on_message(const std::string& text, bool) override {
        if (!trusted_) {
            const auto hello = nlohmann::json::parse(text, nullptr, false);
            trusted_ = hello.is_object() && hello.contains("token") && hello["token"].is_string() &&
                       service_.control->is_token(hello["token"].get<std::string>());
            if (!trusted_) return close();
            return reply(R"({"op":"token","ok":true})");
        }
        // The session can end before a reply.
        service_.control->handle(text, [weak = weak_from_this(), this](const nlohmann::json& result) {
            if (const auto self = weak.lock())
                reply(result.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
        });
    }

    void reply(std::string text) {
        if (queued_messages() >= max_waiting) return close();
        send(std::make_shared<const std::string>(std::move(text)));
    }

    Service& service_;
    bool trusted_ = false; ///< the client has sent the token
};

namespace beast = boost::beast;
namespace http = boost::beast::http;
using http::status;

/// Time limit for a request's header, and between two requests of a connection.
constexpr std::chrono::seconds read_bound{5};
/// Time limit for a response, which has a few MB at most.
constexpr std::chrono::seconds write_bound{20};
/// Limits for reading the rest of a client's data after a refusal.
constexpr std::chrono::seconds drain_bound{2};
constexpr std::size_t max_drained = 256 << 10;

bool has_body(const Request& request) {
    return request.chunked() || (request.has_content_length() && request[http::field::content_length] != "0");
}

} // namespace

HttpSession::HttpSession(boost::asio::ip::tcp::socket socket, Service& service, Place place, bool refuse)
    : stream_(std::move(socket)), service_(service), place_(std::move(place)), refuse_(refuse) {}

void HttpSession::read() {
    parser_.emplace();
    parser_->header_limit(max_header);
    stream_.expires_after(read_bound);
    http::async_read_header(
        stream_, buffer_, *parser_,
        [self = shared_from_this()](beast::error_code failure, std::size_t) { self->on_read(failure); });
}

void HttpSession::on_read(beast::error_code failure) {
    const auto refuse_with = [&](status code, const char* line) {
        Response response = text_response(code, line);
        response.keep_alive(false);
        write(std::move(response));
    };
    if (failure == http::error::header_limit || failure == http::error::buffer_overflow)
        return refuse_with(status::request_header_fields_too_large, "expected a header of at most 8 KiB");
    if (failure && failure != http::error::end_of_stream && failure != http::error::partial_message &&
        failure.category() == http::make_error_code(http::error::bad_method).category())
        return refuse_with(status::bad_request, "expected an HTTP request");
    if (failure) return; // the client closed the connection or was silent for too long
    const Request& request = parser_->get();
    if (refuse_)
        return refuse_with(status::service_unavailable, "64 connections are open; close one and try again");
    if (!is_host_allowed(request, service_))
        return refuse_with(status::forbidden, "expected an address of this machine in the header Host");
    if (request.method() == http::verb::get && has_body(request))
        return refuse_with(status::payload_too_large, "expected a request without a body");
    if (beast::websocket::is_upgrade(request) && asks_for_foxglove(request)) {
        const std::string token = token_of(request);
        if (!token.empty() && (service_.control == nullptr || !service_.control->is_token(token)))
            return refuse_with(status::forbidden, "expected the token printed by tandem monitor --control");
        if (may_look(request, service_)) return become<FoxgloveSession>();
        return refuse_with(
            status::forbidden,
            "expected the monitor's own page or an origin given with --allow-origin in the header Origin");
    }
    const bool live = request.target() == "/api/live", control = request.target() == "/api/control";
    if (control && service_.control == nullptr)
        return refuse_with(status::forbidden,
                           "the monitor is read-only; start it with tandem monitor --control");
    if (beast::websocket::is_upgrade(request) && (live || control)) {
        if (is_origin_own(request)) return control ? become<ControlSession>() : become<PageSession>();
        return refuse_with(status::forbidden, "expected the monitor's own page in the header Origin");
    }
    Response response = respond(request, service_);
    response.keep_alive(request.keep_alive() && !has_body(request));
    write(std::move(response));
}

template <class Session>
void HttpSession::become() {
    stream_.expires_never(); // the WebSocket has its own time-outs
    std::make_shared<Session>(std::move(stream_), service_, std::move(*place_))->run(parser_->release());
}

void HttpSession::write(Response response) {
    response_ = std::move(response);
    response_.prepare_payload();
    stream_.expires_after(write_bound);
    http::async_write(
        stream_, response_,
        [self = shared_from_this()](beast::error_code failure, std::size_t) { self->on_write(failure); });
}

void HttpSession::on_write(beast::error_code failure) {
    if (failure) return;
    if (response_.keep_alive()) return read();
    beast::error_code ignored; // the client may be gone
    stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
    stream_.expires_after(drain_bound);
    drain();
}

/// Reads until the client closes. Unread bytes would make the kernel reset the connection before the client reads the
/// answer.
void HttpSession::drain() {
    stream_.async_read_some(boost::asio::buffer(drained_),
                            [self = shared_from_this()](beast::error_code failure, std::size_t bytes) {
                                self->drained_bytes_ += bytes;
                                if (!failure && self->drained_bytes_ < max_drained) self->drain();
                            });
}

} // namespace tandem::monitor
