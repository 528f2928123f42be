// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/web/http_session.hpp"

#include "apps/tandem/monitor/control/control.hpp"
#include "apps/tandem/monitor/control/recordings.hpp"
#include "apps/tandem/monitor/foxglove/foxglove_session.hpp"
#include "apps/tandem/monitor/samples/sample_session.hpp"
#include "apps/tandem/monitor/web/page_session.hpp"
#include "apps/tandem/monitor/web/websocket_session.hpp"
#include "apps/tandem/output/print_note.hpp"

#include <boost/beast/websocket/rfc6455.hpp>
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>

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
        if (refused_) return;
        if (!trusted_) {
            const auto hello = nlohmann::json::parse(text, nullptr, false);
            trusted_ = hello.is_object() && hello.contains("token") && hello["token"].is_string() &&
                       service_.control->is_token(hello["token"].get<std::string>());
            refused_ = !trusted_;
            return reply(trusted_ ? R"({"op":"token","ok":true})" : R"({"op":"token","ok":false})");
        }
        // The session can end before a reply.
        service_.control->handle(text, [weak = weak_from_this(), this](const nlohmann::json& result) {
            if (const auto self = weak.lock())
                reply(result.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
        });
    }

    void on_sent() override {
        if (refused_) close();
    }

    void reply(std::string text) {
        if (queued_messages() >= max_waiting) return close();
        send(std::make_shared<const std::string>(std::move(text)));
    }

    Service& service_;
    bool trusted_ = false; ///< the client has sent the token
    bool refused_ = false; ///< it has sent another one
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

constexpr std::string_view recordings_path = "/api/recordings/";

constexpr const char* read_only = "the monitor is read-only; start it with tandem monitor --control";

boost::asio::ip::address local_address(const boost::asio::ip::tcp::socket& socket) {
    beast::error_code ignored; // the client may be gone
    return socket.local_endpoint(ignored).address();
}

/// A file that is being sent to a client. Each part must be written within `write_bound`.
struct Download {
    /// `file`: open, because the serializer takes its size at once.
    explicit Download(http::file_body::value_type file) : response(status::ok, 11, std::move(file)) {}

    http::response<http::file_body> response;
    http::response_serializer<http::file_body> serializer{response};
};

template <class Done>
void send_part(beast::tcp_stream& stream, const std::shared_ptr<Download>& download, Done done) {
    stream.expires_after(write_bound);
    http::async_write_some(stream, download->serializer,
                           [&stream, download, done](beast::error_code failure, std::size_t) {
                               if (failure || download->serializer.is_done()) return done(failure);
                               send_part(stream, download, done);
                           });
}

bool has_body(const Request& request) {
    return request.chunked() || (request.has_content_length() && request[http::field::content_length] != "0");
}

} // namespace

HttpSession::HttpSession(boost::asio::ip::tcp::socket socket, Service& service)
    : stream_(std::move(socket)), service_(service), peer_(find_peer(stream_.socket())),
      local_(local_address(stream_.socket())) {}

void HttpSession::run() {
    service_.requests.add(*this);
    read();
}

/// Another connection needs the place. The answer may be lost, because a client that does not read must not delay the
/// monitor.
void HttpSession::give_way(bool of_peer) {
    const std::string line =
        of_peer ? fmt::format("{} connections of one user or address are open, and this one waited longest",
                              RequestPool::max_of_a_peer)
                : fmt::format("{} connections are open, and this one waited longest", RequestPool::max_open);
    log_refusal(line);
    boost::beast::error_code ignored; // the client may be gone
    if (reading_) {
        Response response =
            text_response(of_peer ? status::too_many_requests : status::service_unavailable, line);
        response.keep_alive(false);
        response.prepare_payload();
        std::ostringstream text;
        text << response;
        stream_.socket().non_blocking(true, ignored);
        stream_.socket().write_some(boost::asio::buffer(text.str()), ignored);
    }
    stream_.close();
}

void HttpSession::log_refusal(const std::string& line) {
    if (service_.refused.should_log())
        command::print_note("tandem: refused a connection of {} ({} so far): {}\n", describe(peer_),
                            service_.refused.count(), line);
}

void HttpSession::read() {
    reading_ = true;
    service_.requests.renew(*this);
    parser_.emplace();
    parser_->header_limit(max_header);
    stream_.expires_after(read_bound);
    http::async_read_header(
        stream_, buffer_, *parser_,
        [self = shared_from_this()](beast::error_code failure, std::size_t) { self->on_read(failure); });
}

void HttpSession::refuse(status code, const std::string& line) {
    Response response = text_response(code, line);
    response.keep_alive(false);
    write(std::move(response));
}

void HttpSession::on_read(beast::error_code failure) {
    if (failure == http::error::header_limit || failure == http::error::buffer_overflow)
        return refuse(status::request_header_fields_too_large, "expected a header of at most 8 KiB");
    if (failure && failure != http::error::end_of_stream && failure != http::error::partial_message &&
        failure.category() == http::make_error_code(http::error::bad_method).category())
        return refuse(status::bad_request, "expected an HTTP request");
    if (failure) return; // the client closed the connection, was silent for too long, or had to give way
    answer(parser_->get());
}

void HttpSession::answer(const Request& request) {
    if (!is_host_allowed(request, service_, local_))
        return refuse(status::forbidden, "expected localhost or the address of this machine in the header "
                                         "Host; tandem monitor --allow-host NAME allows another name");
    if (request.method() == http::verb::get && has_body(request))
        return refuse(status::payload_too_large, "expected a request without a body");
    if (beast::websocket::is_upgrade(request)) return upgrade(request);
    if (path_of(request) == "/api/control" && service_.control == nullptr)
        return refuse(status::forbidden, read_only);
    if (request.method() == http::verb::get && path_of(request).rfind(recordings_path, 0) == 0)
        return send_recording(request);
    Response response = respond(request, service_);
    response.keep_alive(request.keep_alive() && !has_body(request));
    write(std::move(response));
}

/// Recordings contain all messages, so they are for clients with the token.
void HttpSession::send_recording(const Request& request) {
    if (service_.control == nullptr) return refuse(status::forbidden, read_only);
    if (!service_.control->is_token(token_of(request)))
        return refuse(status::forbidden,
                      "expected the token printed by tandem monitor --control, as ?token=...");
    const std::string name = path_of(request).substr(recordings_path.size());
    const auto path = find_recording(".", name); // current_path() throws if the folder was removed
    http::file_body::value_type file;
    beast::error_code failure;
    if (path) file.open(path->c_str(), beast::file_mode::scan, failure);
    if (!path || failure)
        return refuse(status::not_found,
                      "no such recording in the folder in which tandem monitor was started");
    const auto download = std::make_shared<Download>(std::move(file));
    auto& response = download->response;
    response.set(http::field::content_type, "application/octet-stream");
    response.set(http::field::content_disposition, "attachment; filename=\"" + name + "\"");
    response.set(http::field::cache_control, "no-store");
    response.set("X-Content-Type-Options", "nosniff");
    response.keep_alive(false);
    response_.keep_alive(false); // on_write() closes the connection
    response.prepare_payload();
    reading_ = false;
    service_.requests.renew(*this);
    send_part(stream_, download,
              [self = shared_from_this()](beast::error_code failed) { self->on_write(failed); });
}

void HttpSession::upgrade(const Request& request) {
    const std::string token = token_of(request), path = path_of(request);
    const bool has_token = service_.control != nullptr && service_.control->is_token(token);
    if (asks_for_foxglove(request)) {
        if (!token.empty() && !has_token)
            return refuse(status::forbidden, "expected the token printed by tandem monitor --control");
        if (may_look(request, service_)) return become<FoxgloveSession>(has_token);
        return refuse(status::forbidden, "expected the monitor's own page or an origin given with "
                                         "--allow-origin in the header Origin");
    }
    const bool control = path == "/api/control";
    if (control && service_.control == nullptr) return refuse(status::forbidden, read_only);
    const bool samples = path == "/api/samples";
    if (!control && !samples && path != "/api/live")
        return refuse(status::not_found,
                      "expected /api/live, /api/samples, /api/control or foxglove.websocket.v1");
    if (!is_origin_own(request))
        return refuse(status::forbidden, "expected the monitor's own page in the header Origin");
    if (samples) return become<SampleSession>(has_token);
    return control ? become<ControlSession>(has_token) : become<PageSession>(has_token);
}

template <class Session>
void HttpSession::become(bool has_token) {
    auto place = service_.web_sockets.take(peer_.key, has_token);
    if (!place) {
        const bool of_peer = service_.web_sockets.is_peer_full(peer_.key);
        const std::string line =
            of_peer ? fmt::format("{} WebSockets of one user or address are open; close one and try again",
                                  Places::max_of_a_peer)
                    : fmt::format("{} WebSockets are open; close one and try again", Places::max_open);
        log_refusal(line);
        return refuse(of_peer ? status::too_many_requests : status::service_unavailable, line);
    }
    service_.requests.remove(*this);
    stream_.expires_never(); // the WebSocket has its own time-outs
    std::make_shared<Session>(std::move(stream_), service_, std::move(*place))->run(parser_->release());
}

void HttpSession::write(Response response) {
    reading_ = false;
    service_.requests.renew(*this);
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
