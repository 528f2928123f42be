// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::shm {

/// Removes this user's segments, of all links, in which a side has lived and none lives any more: what both hosts of a
/// link leave behind when they are killed. Keeps all other files and those of other users. Removes nothing while the
/// environment has TANDEM_KEEP_DEAD_SEGMENTS. Never throws; what cannot be removed stays. [any-process]
void remove_dead_segments();

} // namespace tandem::shm
