// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/harness/case.hpp"

#include "apps/bench/harness/cases.hpp"

#include <algorithm>
#include <map>

namespace tandem::bench {

const char* name_of(Group group) {
    static constexpr const char* names[] = {"baseline", "tandem", "peer"};
    return names[static_cast<int>(group)];
}
const char* name_of(Wake wake) {
    static constexpr const char* names[] = {"-", "spin", "spin-then-futex", "blocking"};
    return names[static_cast<int>(wake)];
}
const char* name_of(Regime regime) {
    static constexpr const char* names[] = {"normal", "low-latency-idle", "same-core", "loaded"};
    return names[static_cast<int>(regime)];
}
const char* name_of(Placement placement) {
    static constexpr const char* names[] = {"processes", "threads", "alone"};
    return names[static_cast<int>(placement)];
}
const char* name_of(Unit unit) {
    static constexpr const char* names[] = {"ns", "GB/s", "M/s", "count"};
    return names[static_cast<int>(unit)];
}

std::string size_text(std::size_t bytes) {
    if (bytes >= 1U << 20U && bytes % (1U << 20U) == 0) return std::to_string(bytes >> 20U) + "M";
    if (bytes >= 1U << 10U && bytes % (1U << 10U) == 0) return std::to_string(bytes >> 10U) + "K";
    return std::to_string(bytes);
}

std::string Case::id() const {
    std::string id = std::string(name_of(group)) + "/" + subject + "/" + operation + "/" + size_text(bytes);
    if (wake != Wake::none) id += std::string("/") + name_of(wake);
    if (!detail.empty()) id += "/" + detail;
    if (placement == Placement::threads) id += "/threads";
    if (regime != Regime::normal) id += std::string("/") + name_of(regime);
    return id;
}

std::string Case::topic() const {
    // The cache line and the short record belong to the 64-byte crossing.
    const std::size_t size = bytes < 64 ? 64 : bytes;
    return operation + "/" + size_text(size) + "/" + name_of(regime);
}

void Registry::add_regimes(const Case& entry) {
    cases.push_back(entry);
    if (entry.wake == Wake::spin)
        return; // never sleeps: the idle state does not matter, one core cannot do it
    for (Regime regime : {Regime::low_latency_idle, Regime::same_core}) {
        cases.push_back(entry);
        cases.back().regime = regime;
    }
}

Registry all_cases() {
    Registry registry;
    add_cache_line_cases(registry);
    add_index_ring_cases(registry);
    add_hand_written_cases(registry);
    add_memory_cases(registry);
    add_tandem_ring_cases(registry);
    add_tandem_bridge_cases(registry);
    add_tandem_stream_cases(registry);
    add_tandem_call_cases(registry);
    add_tandem_port_cases(registry);
    add_tandem_opros_cases(registry);
    add_tandem_publish_count_cases(registry);
    add_tandem_rtm_cases(registry);
    add_tandem_wheelchair_cases(registry);
    add_peer_cases(registry);
    std::map<std::string, std::size_t> order;
    for (const Case& entry : registry.cases) order.emplace(entry.topic(), order.size());
    std::stable_sort(registry.cases.begin(), registry.cases.end(),
                     [&](const Case& a, const Case& b) { return order.at(a.topic()) < order.at(b.topic()); });
    return registry;
}

} // namespace tandem::bench
