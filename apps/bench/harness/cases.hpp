// SPDX-License-Identifier: Apache-2.0
// Where the cases come from: one function per file of cases.
#pragma once

namespace tandem::bench {

struct Registry;

void add_cache_line_cases(Registry& registry);
void add_index_ring_cases(Registry& registry);
void add_hand_written_cases(Registry& registry);
void add_memory_cases(Registry& registry);
void add_tandem_bridge_cases(Registry& registry);
void add_tandem_ring_cases(Registry& registry);
void add_tandem_stream_cases(Registry& registry);
void add_tandem_call_cases(Registry& registry);
void add_tandem_port_cases(Registry& registry);
void add_tandem_opros_cases(Registry& registry);
void add_tandem_publish_count_cases(Registry& registry);
void add_tandem_rtm_cases(Registry& registry);
void add_tandem_wheelchair_cases(Registry& registry);

void add_peer_cases(Registry& registry); ///< those that this build has, and the names of the others
void add_boost_cases(Registry& registry);
void add_cyclictest_cases(Registry& registry);
void add_cyclone_cases(Registry& registry);
void add_iceoryx_cases(Registry& registry);
void add_mqueue_cases(Registry& registry);
void add_omniorb_cases(Registry& registry);
void add_socket_cases(Registry& registry);
void add_zeromq_cases(Registry& registry);

} // namespace tandem::bench
