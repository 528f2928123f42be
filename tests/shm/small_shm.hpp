// SPDX-License-Identifier: Apache-2.0
// A /dev/shm of a few MiB, for a child process.
#pragma once
#include "shm/segment/segment_file.hpp"

#include <fstream>
#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

namespace tandem::shm::test {

constexpr int not_permitted = 77; ///< exit code of a child that may not do what it is for

/// A user who may mount, who is the same one outside.
inline bool become_root_of_own_namespace() {
    const auto tell = [](const char* file, const std::string& text) {
        std::ofstream(file) << text << std::flush;
    };
    const std::string user = std::to_string(geteuid()), group = std::to_string(getegid());
    if (unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
    tell("/proc/self/setgroups", "deny");
    tell("/proc/self/uid_map", user + " " + user + " 1");
    tell("/proc/self/gid_map", group + " " + group + " 1");
    return true;
}

/// In a mount namespace of its own, with a /dev/shm of that many MiB; false where that is not allowed.
inline bool enter_small_shm(int mib = 1) {
    const std::string options = "size=" + std::to_string(mib) + "m,mode=1777";
    if (unshare(CLONE_NEWNS) != 0 && !become_root_of_own_namespace()) return false;
    return mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
           mount("tmpfs", shm_directory, "tmpfs", 0, options.c_str()) == 0;
}

} // namespace tandem::shm::test
