// SPDX-License-Identifier: Apache-2.0
// The server's answers, as functions of a request's header, without a connection.
#pragma once
#include "apps/tandem/monitor/web/service.hpp"

#include <boost/beast/http.hpp>

#include <string>

namespace tandem::monitor {

using Request = boost::beast::http::request<boost::beast::http::empty_body>;
using Response = boost::beast::http::response<boost::beast::http::string_body>;

/// Returns a response with one line of text, for example a refusal.
Response text_response(boost::beast::http::status status, const std::string& line);

/// Returns the answer to a request without a WebSocket. Throws std::bad_alloc.
Response respond(const Request& request, const Service& service);

/// Returns the request's path without its query.
std::string path_of(const Request& request);
/// Returns whether the header `Host` allows an answer, see AllowedHosts. `local`: this end of the connection.
bool is_host_allowed(const Request& request, const Service& service, const boost::asio::ip::address& local);
/// Returns whether a WebSocket comes from the server's own page, by the header `Origin`, which browsers set. Call it
/// after is_host_allowed(), because it compares with `Host`.
bool is_origin_own(const Request& request);
/// Returns the address's text after `?token=`; empty if there is none.
std::string token_of(const Request& request);
/// Returns whether the client is a program (without `Origin`), the own page, or an allowed page.
bool may_look(const Request& request, const Service& service);

} // namespace tandem::monitor
