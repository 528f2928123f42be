// SPDX-License-Identifier: Apache-2.0
// A /dev/shm of a few MiB, for a child process.
#pragma once
#include "shm/segment/segment_file.hpp"
#include "tests/support/own_namespaces.hpp"

#include <string>
#include <sys/mount.h>

namespace tandem::shm::test {

constexpr int not_permitted = 77; ///< exit code of a child that may not do what it is for

/// Runs in a separate mount namespace with a /dev/shm of this number of MiB. Returns false if that is not
/// permitted.
inline bool enter_small_shm(int mib = 1) {
    const std::string options = "size=" + std::to_string(mib) + "m,mode=1777";
    if (!tandem::test::enter_own_namespaces(CLONE_NEWNS)) return false;
    return mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
           mount("tmpfs", shm_directory, "tmpfs", 0, options.c_str()) == 0;
}

} // namespace tandem::shm::test
