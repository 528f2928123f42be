// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/samples/sample_session.hpp"

#include "shm/os/error.hpp"
#include "shm/segment/segment_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <optional>

namespace tandem::monitor {
namespace {

using PlainJson = nlohmann::json;

/// Throws nlohmann::json::exception or shm::Error for what is not a port.
SamplePort port_in(const PlainJson& item) {
    SamplePort port;
    port.link = item.at("link").get<std::string>();
    port.owner = item.at("owner").get<std::string>() == "second" ? shm::Side::second : shm::Side::first;
    port.name = item.at("port").get<std::string>();
    shm::check_link_name(port.link);
    return port;
}

/// Returns the ports of a request `{"follow": [{"link", "owner", "port"} ...]}`; nullopt for anything else.
std::optional<std::set<SamplePort>> ports_in(const std::string& text) {
    const PlainJson request = PlainJson::parse(text, nullptr, false);
    if (!request.is_object() || !request.contains("follow") || !request["follow"].is_array() ||
        request["follow"].size() > SampleSession::max_ports)
        return std::nullopt;
    std::set<SamplePort> ports;
    try {
        for (const PlainJson& item : request["follow"]) ports.insert(port_in(item));
    } catch (const PlainJson::exception&) {
        return std::nullopt;
    } catch (const shm::Error&) {
        return std::nullopt;
    }
    return ports;
}

} // namespace

SampleSession::SampleSession(boost::beast::tcp_stream stream, Service& service, Place place)
    : WebSocketSession(std::move(stream), std::move(place), std::chrono::seconds(30), max_message),
      service_(service) {}

SampleSession::~SampleSession() {
    if (service_.samples != nullptr) service_.samples->remove(*this);
}

void SampleSession::on_open(const Request&) { service_.samples->add(*this); }

void SampleSession::on_close() { service_.samples->remove(*this); }

void SampleSession::on_message(const std::string& text, bool) {
    auto ports = ports_in(text);
    if (ports) return ports_.swap(*ports);
    const PlainJson refusal{
        {"error", fmt::format("expected {{\"follow\": [{{\"link\", \"owner\", \"port\"}}]}} with at "
                              "most {} ports",
                              max_ports)}};
    if (queued_bytes() < max_queued) send(std::make_shared<const std::string>(refusal.dump()));
}

void SampleSession::samples(std::uint64_t time_ms, const std::string& json) {
    if (queued_bytes(false) > max_queued) return;
    send(std::make_shared<const std::string>(fmt::format(R"({{"time_ms":{},"ports":[{}]}})", time_ms, json)));
}

void SampleSession::left_out(const std::set<SamplePort>& ports) {
    if (ports == left_out_ || queued_bytes() >= max_queued) return;
    PlainJson list = PlainJson::array();
    for (const SamplePort& port : ports)
        list.push_back({{"link", port.link}, {"owner", name_of(port.owner)}, {"port", port.name}});
    send(std::make_shared<const std::string>(
        PlainJson{{"left_out", list}, {"most", SampleFeed::max_ports}}.dump(
            -1, ' ', false, PlainJson::error_handler_t::replace)));
    left_out_ = ports;
}

void SampleSession::picture(const std::shared_ptr<const std::string>& frame) {
    if (queued_bytes(true) <= max_queued) send(frame, true);
}

} // namespace tandem::monitor
