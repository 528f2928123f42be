// SPDX-License-Identifier: Apache-2.0
#include "host/process/memory_file.hpp"

#include <sys/mman.h>
#include <unistd.h>

namespace tandem::process {

void* create_memory_file(const char* name, std::size_t bytes) {
    const int file = memfd_create(name, MFD_CLOEXEC);
    if (file < 0) return nullptr;
    // MAP_POPULATE spares the cycles of components a page fault in this file.
    void* const at = ftruncate(file, static_cast<off_t>(bytes)) == 0
                         ? mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, file, 0)
                         : MAP_FAILED;
    if (at != MAP_FAILED) return at; // the descriptor stays open: other processes find the file by it
    close(file);
    return nullptr;
}

} // namespace tandem::process
