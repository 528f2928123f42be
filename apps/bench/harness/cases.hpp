// SPDX-License-Identifier: Apache-2.0
// Each file of baseline/ and tandem/ defines one of these functions, which adds the cases of that file.
// all_cases() calls them. CMake lists the functions of the peers (peers/peers.cmake).
#pragma once

namespace tandem::bench {

struct Registry;

// baseline/
void add_cache_line_cases(Registry& registry);
void add_hand_written_cases(Registry& registry);
void add_index_ring_cases(Registry& registry);
void add_memory_cases(Registry& registry);

// tandem/
void add_bridge_call_cases(Registry& registry);
void add_bridge_cases(Registry& registry);
void add_call_cases(Registry& registry);
void add_opros_cases(Registry& registry);
void add_paired_cases(Registry& registry);
void add_port_cases(Registry& registry);
void add_publish_count_cases(Registry& registry);
void add_ring_cases(Registry& registry);
void add_rtm_call_cases(Registry& registry);
void add_rtm_cases(Registry& registry);
void add_scale_cases(Registry& registry);
void add_stream_cases(Registry& registry);
void add_wheelchair_cases(Registry& registry);

// path/
void add_path_cases(Registry& registry);

/// peers/: adds the cases of the peers that this build has, and the names of the other peers with the reason.
void add_peer_cases(Registry& registry);

} // namespace tandem::bench
