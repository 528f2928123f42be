// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <linux/membarrier.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace tandem::test {

/// Returns whether an rt::ShortMutex gets an owner here: not without membarrier(2), nor under the thread
/// sanitizer.
inline bool mutexes_have_owners() {
#ifdef __SANITIZE_THREAD__
    return false;
#else
    const long commands = syscall(SYS_membarrier, MEMBARRIER_CMD_QUERY, 0, 0);
    return commands > 0 && (commands & MEMBARRIER_CMD_REGISTER_PRIVATE_EXPEDITED) != 0;
#endif
}

} // namespace tandem::test
