// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstring>

namespace tandem::process {

/// Creates and maps a memory file. Other processes of the same user find it by `name` as /proc/PID/fd/N. The file and
/// the mapping stay until the process ends. Returns NULL if the system does not permit it. [any-thread]
void* create_memory_file(const char* name, std::size_t bytes);

/// Creates a memory file named File::file_name for one File. Sets `magic` to `magic_text`; all other bytes are zero.
template <class File>
File* create_memory_file() {
    auto* const file = static_cast<File*>(create_memory_file(File::file_name, sizeof(File)));
    if (file != nullptr) std::memcpy(file->magic, File::magic_text, sizeof file->magic);
    return file;
}

} // namespace tandem::process
