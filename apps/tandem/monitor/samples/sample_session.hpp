// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/samples/sample_feed.hpp"
#include "apps/tandem/monitor/web/websocket_session.hpp"

#include <set>
#include <string>

namespace tandem::monitor {

/// A page that plots ports. Each message of it is the list of ports that it follows from then on. [one thread]
class SampleSession final : public WebSocketSession, private SampleClient {
  public:
    static constexpr std::size_t max_message = 16 << 10; ///< bytes of a client's message
    static constexpr std::size_t max_ports = 16;         ///< that a client can follow
    static constexpr std::size_t max_queued =
        1 << 20; ///< bytes of samples, and of pictures; a slow client misses what comes beyond

    SampleSession(boost::beast::tcp_stream stream, Service& service, Place place);
    ~SampleSession() override;

  private:
    void samples(std::uint64_t time_ms, const std::string& json) override;
    void picture(const std::shared_ptr<const std::string>& frame) override;
    const std::set<SamplePort>& ports() const override { return ports_; }
    void left_out(const std::set<SamplePort>& ports) override;

    void on_open(const Request& request) override;
    void on_message(const std::string& text, bool binary) override;
    void on_close() override;

    Service& service_;
    std::set<SamplePort> ports_, left_out_;
};

} // namespace tandem::monitor
