// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/web/page_session.hpp"

#include <utility>

namespace tandem::monitor {

PageSession::PageSession(boost::beast::tcp_stream stream, Service& service, Place place)
    : WebSocketSession(std::move(stream), std::move(place), std::chrono::seconds(30), max_message),
      service_(service) {}

void PageSession::on_open(const Request&) {
    service_.live.insert(this);
    send(service_.state);
}

void PageSession::send_state(std::shared_ptr<const std::string> state) {
    if (queued_messages() == 0) return send(std::move(state));
    next_ = std::move(state);
    if (++skipped_ >= max_skipped) close();
}

void PageSession::on_sent() {
    skipped_ = 0;
    if (next_ != nullptr) send(std::exchange(next_, nullptr));
}

} // namespace tandem::monitor
