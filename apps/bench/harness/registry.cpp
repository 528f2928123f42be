// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/harness/registry.hpp"

#include "apps/bench/harness/cases.hpp"

#include <algorithm>
#include <map>

namespace tandem::bench {

void Registry::add_with_conditions(const Case& entry) {
    add(entry);
    if (entry.wake == Wake::spin) return;
    Case idle = entry;
    idle.power_profile = PowerProfile::low_latency_idle;
    add(idle);
    Case same_core = entry;
    same_core.placement = Placement::same_core;
    add(same_core);
}

Registry all_cases() {
    Registry registry;
    add_cache_line_cases(registry);
    add_index_ring_cases(registry);
    add_hand_written_cases(registry);
    add_memory_cases(registry);
    add_ring_cases(registry);
    add_bridge_cases(registry);
    add_stream_cases(registry);
    add_call_cases(registry);
    add_bridge_call_cases(registry);
    add_port_cases(registry);
    add_paired_cases(registry);
    add_opros_cases(registry);
    add_publish_count_cases(registry);
    add_rtm_call_cases(registry);
    add_rtm_cases(registry);
    add_wheelchair_cases(registry);
    add_scale_cases(registry);
#ifdef TANDEM_BENCH_PATH
    add_path_cases(registry);
#else
    registry.skipped.push_back({"path", "instructions are counted on x86-64 only"});
#endif
    add_peer_cases(registry);
    // Comparison keys, and the cases of each key, keep the order in which they first appear above.
    std::map<std::string, std::size_t> order;
    for (const Case& entry : registry.cases) order.emplace(entry.comparison_key(), order.size());
    std::stable_sort(registry.cases.begin(), registry.cases.end(), [&](const Case& a, const Case& b) {
        return order.at(a.comparison_key()) < order.at(b.comparison_key());
    });
    return registry;
}

} // namespace tandem::bench
