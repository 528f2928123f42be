// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/shared_ports/running_host.hpp"

#include "proxy/interceptor/model.hpp"
#include "proxy/link/session/link_session.hpp"
#include "proxy/wire/type_text.hpp"
#include "shm/inspect/observer.hpp"

#include <chrono>
#include <thread>

namespace tandem::command {
namespace {

const char* kind_of(const link::Port& port, const std::set<std::string>& event_ports) {
    if (!link::is_data_port(port.kind)) return "service";
    return port.is_event_in_port() || event_ports.contains(port.name) ? "event" : "data";
}

} // namespace

// InterceptorComp publishes its table when it joins and when its ports change. Retries while a side is changing its table.
std::optional<link::PortTable> read_shared_ports(const std::string& link) {
    constexpr int attempts = 20;
    for (int attempt = 0; attempt < attempts; ++attempt) {
        const auto observation = shm::observe(link);
        if (!observation) return std::nullopt;
        bool all_read = true;
        for (const auto& blob : observation->blobs) {
            if (blob.name != link::table_name || !observation->segment.side(blob.owner).held) continue;
            auto published = link::read_published_table(blob.content);
            if (published && published->table.model == interceptor::model) return std::move(published->table);
            all_read = all_read && published;
        }
        if (all_read) return std::nullopt;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return std::nullopt;
}

nlohmann::json describe_mirrors(const link::PortTable& table, const std::set<std::string>& event_ports) {
    using nlohmann::json;
    static constexpr const char* directions[] = {"output", "input", "provided",
                                                 "required"}; // by link::PortKind
    json ports = json::array();
    for (const auto& port : table.ports) {
        json out{{"name", port.name},
                 {"kind", kind_of(port, event_ports)},
                 {"direction", directions[static_cast<std::size_t>(port.kind)]},
                 {"type", nullptr}};
        if (link::is_data_port(port.kind)) out["signature"] = wire::without_names(port.signature);
        for (const auto& operation : port.operations)
            out["methods"].push_back(
                {{"name", operation.name}, {"signature", wire::without_names(operation.signature)}});
        ports.push_back(std::move(out));
    }
    return ports;
}

} // namespace tandem::command
