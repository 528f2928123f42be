// SPDX-License-Identifier: Apache-2.0
#include "host/process/published/memory_file.hpp"

#include "shm/os/open_file.hpp"

#include <sys/mman.h>
#include <unistd.h>

namespace tandem::process {

boost::interprocess::mapped_region create_memory_file(const char* name, std::size_t bytes) {
    namespace ipc = boost::interprocess;
    const int file = memfd_create(name, MFD_CLOEXEC);
    if (file < 0) return {};
    try {
        // The descriptor stays open, because other processes find the file by it. MAP_POPULATE spares the cycles of components
        // a page fault in this file.
        if (ftruncate(file, static_cast<off_t>(bytes)) == 0)
            return {shm::OpenFile(file), ipc::read_write, 0, bytes, nullptr, MAP_POPULATE};
    } catch (const ipc::interprocess_exception&) { // no memory: as below
    }
    close(file);
    return {};
}

} // namespace tandem::process
