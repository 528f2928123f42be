// SPDX-License-Identifier: Apache-2.0
// The cores on which a case runs. A and B are pinned, because the time between two cores depends on which two
// they are.
#pragma once
#include <sys/types.h>
#include <vector>

namespace tandem::bench {

/// The cores of the two sides of a case; the same one twice on a machine with a single core.
struct Cores {
    int a = 0, b = 1;
};

/// [calling thread] Pins the thread to this core. Throws std::system_error.
void pin_to(int core);
/// [any thread] Pins a thread of any process to this core. Returns false if that is not permitted or the thread
/// has ended.
bool pin_thread_to(pid_t thread, int core);
/// [calling thread] Lets the thread run on any core that the process may use. Throws std::system_error.
void pin_to_all_cores();
/// Returns the cores that this process may use, in ascending order.
std::vector<int> allowed_cores();

} // namespace tandem::bench
