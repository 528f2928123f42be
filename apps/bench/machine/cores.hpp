// SPDX-License-Identifier: Apache-2.0
// Which cores a case runs on. A and B are pinned, since the way between two cores depends on which two.
#pragma once
#include <sys/types.h>
#include <vector>

namespace tandem::bench {

/// The cores of the two sides of a case; the same one twice on a machine with a single core.
struct Cores {
    int a = 0, b = 1;
};

/// [calling thread] Runs on this core only from here on. Throws std::system_error.
void pin_to(int core);
/// [any thread] As pin_to(), for a thread of any process. Returns false if that is not permitted or the thread has ended.
bool pin_thread_to(pid_t thread, int core);
/// [calling thread] Runs on any core that the process may use. Throws std::system_error.
void pin_to_all_cores();
/// The cores that this process may use, in ascending order.
std::vector<int> allowed_cores();

} // namespace tandem::bench
