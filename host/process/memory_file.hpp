// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstring>

namespace tandem::process {

/// Creates a memory file of this process, which other processes of its user find by that name as /proc/PID/fd/N, and maps
/// it. Both stay until the process ends. Null where that is not permitted. [any-thread]
void* create_memory_file(const char* name, std::size_t bytes);

/// The same for a File with `file_name`, and with `magic`, which holds `magic_text` from now on; all else is zero.
template <class File>
File* create_memory_file() {
    auto* const file = static_cast<File*>(create_memory_file(File::file_name, sizeof(File)));
    if (file != nullptr) std::memcpy(file->magic, File::magic_text, sizeof file->magic);
    return file;
}

} // namespace tandem::process
