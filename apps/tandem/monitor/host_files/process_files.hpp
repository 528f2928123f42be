// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/state.hpp"
#include "apps/tandem/output/format.hpp"
#include "host/process/file_descriptor.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
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

/// Opens up to `most` memory files of a process that have this name and size in bytes. Returns none of another user's
/// process, and none that the process only reads.
std::vector<process::FileDescriptor> open_memory_files(std::uint32_t pid, const char* name, std::size_t size,
                                                       std::size_t most);

/// Returns a text from such a file. The text may be unterminated and contain any bytes.
template <std::size_t Size>
std::string printable_text(const char (&text)[Size]) {
    return command::replace_nonprintable(std::string(text, strnlen(text, Size)));
}

/// Interval for finding new files of a process, because reading /proc/PID/fd costs more than reading the files.
inline constexpr std::uint64_t look_pause_ns = 2'000'000'000;

} // namespace tandem::monitor
