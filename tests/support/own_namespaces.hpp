// SPDX-License-Identifier: Apache-2.0
// Namespaces for one test: it can neither affect other processes nor be affected by them.
#pragma once
#include <fstream>
#include <sched.h>
#include <string>
#include <unistd.h>

namespace tandem::test {

/// Puts this process into new namespaces, CLONE_NEW... of unshare(2); where its user may not do that, in a user namespace in which
/// he may, and is the same one outside. False where that is not permitted either. The process must have one thread.
inline bool enter_own_namespaces(int flags) {
    const auto tell = [](const char* file, const std::string& text) {
        std::ofstream(file) << text << std::flush;
    };
    const std::string user = std::to_string(geteuid()), group = std::to_string(getegid());
    if (unshare(flags) == 0) return true;
    if (unshare(CLONE_NEWUSER | flags) != 0) return false;
    tell("/proc/self/setgroups", "deny");
    tell("/proc/self/uid_map", user + " " + user + " 1");
    tell("/proc/self/gid_map", group + " " + group + " 1");
    return true;
}

} // namespace tandem::test
