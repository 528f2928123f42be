// SPDX-License-Identifier: Apache-2.0
// Where the cases come from: one function per file of cases.
#pragma once

namespace tandem::bench {

struct Registry;

void add_floor_line_cases(Registry& registry);
void add_floor_ring_cases(Registry& registry);
void add_floor_loop_cases(Registry& registry);
void add_floor_memory_cases(Registry& registry);
void add_our_bridge_cases(Registry& registry);
void add_our_ring_cases(Registry& registry);
void add_our_stream_cases(Registry& registry);
void add_our_call_cases(Registry& registry);
void add_our_port_cases(Registry& registry);
void add_our_opros_cases(Registry& registry);
void add_our_publish_count_cases(Registry& registry);
void add_our_rtm_cases(Registry& registry);
void add_our_wheelchair_cases(Registry& registry);

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
