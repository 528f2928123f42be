// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tandem::test {

/// In a child process, calls `check` with a function that makes any further thread fail. Returns false if `check` does, or if
/// the child crashes. Root has no limit, so the child of root is another user.
inline bool
holds_at_thread_limit(const std::function<bool(const std::function<void()>& reach_limit)>& check) {
    const pid_t child = fork();
    if (child == 0) {
        constexpr uid_t nobody_else = 54321;
        if (geteuid() == 0 && setresuid(nobody_else, nobody_else, nobody_else) != 0) _exit(2);
        _exit(check([] {
            const rlimit one{1, 1};
            if (setrlimit(RLIMIT_NPROC, &one) != 0) _exit(2);
        })
                  ? 0
                  : 1);
    }
    int status = -1;
    return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

} // namespace tandem::test
