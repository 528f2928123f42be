// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::shm {

/// Removes the segments of this user, of all links, in which a side has lived and none lives any more: what both hosts
/// of a link leave when they are killed. Other files, and those of other users, stay. Nothing is removed while the
/// environment has TANDEM_KEEP_DEAD_SEGMENTS. Never throws; what cannot be removed stays. [any-process]
void remove_dead_segments();

} // namespace tandem::shm
