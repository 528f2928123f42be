// SPDX-License-Identifier: Apache-2.0
// A pid alone does not identify a process: another pid namespace has another process under the same number, and the
// number is reused after the end of its process.
#pragma once
#include <cstdint>

namespace tandem::shm {

/// A process, as it describes itself to processes of any namespace. Fields that are not known are 0.
struct ProcessIdentity {
    std::uint32_t pid = 0;
    std::uint64_t pid_namespace = 0; ///< inode number, see namespaces(7)
    std::uint64_t time_namespace =
        0;                         ///< inode number; start_ticks is comparable only within one time namespace
    std::uint64_t start_ticks = 0; ///< starttime of proc(5)
};

/// Returns the identity of the calling process.
ProcessIdentity identify_this_process();

/// elsewhere: the process belongs to another pid namespace, or is not visible here, so its pid has no meaning here.
enum class ProcessLookup { running, ended, elsewhere };

/// [any-process] Looks for the process. A zombie has ended. Makes up to seven system calls.
ProcessLookup find_process(const ProcessIdentity& identity);

} // namespace tandem::shm
