// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/output/format.hpp"
#include "host/process/file_descriptor.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace tandem::monitor {

/// The memory files of that name and size (bytes) that a process has open, at most so many. None of another user's process.
std::vector<process::FileDescriptor> open_memory_files(std::uint32_t pid, const char* name, std::size_t size,
                                                       std::size_t most);

/// A text of such a file, which may have no end and any bytes.
template <std::size_t Size>
std::string printable_text(const char (&text)[Size]) {
    return command::replace_nonprintable(std::string(text, strnlen(text, Size)));
}

/// How often a process is looked at for files that have come: reading /proc/PID/fd costs more than reading the files.
inline constexpr std::uint64_t look_pause_ns = 2'000'000'000;

} // namespace tandem::monitor
