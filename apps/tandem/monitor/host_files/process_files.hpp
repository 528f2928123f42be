// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/state.hpp"
#include "apps/tandem/output/format.hpp"
#include "host/process/file_descriptor.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <unistd.h>
#include <vector>

namespace tandem::monitor {

/// A process whose files are read.
struct RunningHost {
    std::uint32_t pid = 0;
    std::string program;
};

/// Returns the hosts of the links that are alive, and those without a link, each once. Stopped ones are left out: what they
/// publish does not change.
std::vector<RunningHost> running_hosts(const State& state);

/// Returns the program's name from the kernel; empty if this machine has no such process.
std::string program_of(std::uint32_t pid);

/// Opens the memory files of a process that have this name and size in bytes: up to eight, one for each library that
/// publishes. Returns none of another user's process, and none that the process only reads.
std::vector<process::FileDescriptor> open_memory_files(std::uint32_t pid, const char* name, std::size_t size);

/// Reads such a file. Returns nullptr unless it is one of this kind.
template <class File>
std::unique_ptr<const File> read_memory_file(const process::FileDescriptor& file) {
    auto copy = std::make_unique<File>();
    if (pread(file.get(), copy.get(), sizeof *copy, 0) != static_cast<ssize_t>(sizeof *copy) ||
        std::memcmp(copy->magic, File::magic_text, sizeof copy->magic) != 0)
        return nullptr;
    return copy;
}

/// Calls `read` with the process id and program of each running host. Erases other processes from `known`.
template <class Process, class Read>
void read_running_hosts(const State& state, std::map<std::uint32_t, Process>& known, Read read) {
    std::set<std::uint32_t> present;
    for (const auto& [pid, program] : running_hosts(state)) {
        present.insert(pid);
        read(pid, program);
    }
    std::erase_if(known, [&](const auto& process) { return present.count(process.first) == 0; });
}

/// Returns a text from such a file. The text may be unterminated and contain any bytes.
template <std::size_t Size>
std::string printable_text(const char (&text)[Size]) {
    return command::replace_nonprintable(std::string(text, strnlen(text, Size)));
}

/// Interval for finding new files of a process, because reading /proc/PID/fd costs more than reading the files.
inline constexpr std::uint64_t file_search_pause_ns = 2'000'000'000;

} // namespace tandem::monitor
