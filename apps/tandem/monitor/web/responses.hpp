// SPDX-License-Identifier: Apache-2.0
// What the server answers: functions of a request's header, without a connection.
#pragma once
#include "apps/tandem/monitor/web/service.hpp"

#include <boost/beast/http.hpp>

#include <string>

namespace tandem::monitor {

using Request = boost::beast::http::request<boost::beast::http::empty_body>;
using Response = boost::beast::http::response<boost::beast::http::string_body>;

/// A refusal or another answer of one line of text.
Response text_response(boost::beast::http::status status, const std::string& line);

/// The answer to a request that asks for no WebSocket. Throws std::bad_alloc.
Response respond(const Request& request, const Service& service);

/// Whether to answer at all, by the header `Host`: a page of another site whose name leads to this machine is not to read
/// from a server that listens for this machine only.
bool is_host_allowed(const Request& request, const Service& service);
/// Whether a WebSocket comes from the server's own page, by the header `Origin`, which browsers set.
bool is_origin_own(const Request& request);
/// What the address has behind `?token=`; empty without it.
std::string token_of(const Request& request);
/// Whether a program, which sends no `Origin`, the own page, or a page that is allowed to.
bool may_look(const Request& request, const Service& service);

} // namespace tandem::monitor
