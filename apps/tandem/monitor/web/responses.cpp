// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/web/responses.hpp"

#include "apps/tandem/monitor/metrics.hpp"

namespace tandem::monitor {
namespace {

namespace http = boost::beast::http;
using http::field;
using http::status;

std::string text_of(boost::beast::string_view text) { return {text.data(), text.size()}; }

Response make_response(status code, const std::string& type, std::string body) {
    Response response(code, 11);
    response.set(field::content_type, type);
    response.set(field::cache_control, "no-store");
    response.set("X-Content-Type-Options", "nosniff");
    response.set("Content-Security-Policy",
                 "default-src 'self'; img-src 'self' data:; frame-ancestors 'none'");
    response.body() = std::move(body);
    return response;
}

} // namespace

Response text_response(status code, const std::string& line) {
    return make_response(code, "text/plain; charset=utf-8", line + "\n");
}

Response respond(const Request& request, const Service& service) {
    if (request.method() != http::verb::get) {
        Response response = text_response(status::method_not_allowed, "only GET requests are accepted");
        response.set(field::allow, "GET");
        return response;
    }
    const std::string path = path_of(request);
    if (path == "/api/state") return make_response(status::ok, "application/json", *service.state);
    if (path == "/metrics") return make_response(status::ok, metrics_type, service.metrics());
    if (path == "/api/live" || path == "/api/samples" || path == "/api/control") {
        Response response = text_response(status::upgrade_required, "expected a WebSocket");
        response.set(field::upgrade, "websocket");
        return response;
    }
    const auto file = service.files.find(path);
    if (file == service.files.end())
        return text_response(status::not_found, "expected /, /api/state, /api/live (WebSocket) or /metrics");
    return make_response(status::ok, file->second.type, file->second.content);
}

std::string path_of(const Request& request) {
    const std::string target = text_of(request.target());
    return target.substr(0, target.find('?'));
}

bool is_host_allowed(const Request& request, const Service& service, const boost::asio::ip::address& local) {
    return request.count(field::host) == 1 && service.hosts.allows(text_of(request[field::host]), local);
}

bool is_origin_own(const Request& request) {
    const std::string origin = text_of(request[field::origin]), host = text_of(request[field::host]);
    return !host.empty() && (origin == "http://" + host || origin == "https://" + host);
}

std::string token_of(const Request& request) {
    const std::string target = text_of(request.target());
    static const std::string name = "token=";
    for (std::size_t at = target.find('?'); at != std::string::npos; at = target.find('&', at + 1))
        if (target.compare(at + 1, name.size(), name) == 0)
            return target.substr(at + 1 + name.size(), target.find('&', at + 1) - at - 1 - name.size());
    return {};
}

bool may_look(const Request& request, const Service& service) {
    return request.count(field::origin) == 0 || is_origin_own(request) ||
           service.other_origins.count(text_of(request[field::origin])) != 0;
}

} // namespace tandem::monitor
