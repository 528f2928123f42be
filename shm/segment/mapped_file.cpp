// SPDX-License-Identifier: Apache-2.0
#include "shm/segment/mapped_file.hpp"
#include "shm/os/error.hpp"
#include "shm/os/open_file.hpp"

#include <cerrno>
#include <sys/mman.h>
#include <unistd.h>

namespace tandem::shm {
namespace {

// Only a new mapping shows whether mlockall(MCL_FUTURE) is in effect: then the mapping has its memory at once.
bool locks_future_memory() {
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    void* probe = ::mmap(nullptr, page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (probe == MAP_FAILED) return false;
    unsigned char resident = 0;
    const bool locked = ::mincore(probe, page, &resident) == 0 && (resident & 1U) != 0;
    ::munmap(probe, page);
    return locked;
}

// A mapping without access gets no memory, and a mapping locked on fault gets none when access is granted.
void* map_sparse(int fd, std::size_t bytes) {
    void* address = ::mmap(nullptr, bytes, PROT_NONE, MAP_SHARED, fd, 0);
    if (address == MAP_FAILED) return address;
    if (!locks_future_memory() || ::mlock2(address, bytes, MLOCK_ONFAULT) != 0) ::munlock(address, bytes);
    if (::mprotect(address, bytes, PROT_READ | PROT_WRITE) == 0) return address;
    const int code = errno;
    ::munmap(address, bytes);
    errno = code;
    return MAP_FAILED;
}

} // namespace

MappedFile::MappedFile(int fd, const std::string& path, std::size_t bytes, bool sparse) : size_(bytes) {
    namespace ipc = boost::interprocess;
    try {
        if (!sparse) {
            region_ = ipc::mapped_region(OpenFile(fd), ipc::read_write, 0, bytes, nullptr, MAP_POPULATE);
            address_ = static_cast<std::byte*>(region_.get_address());
            return;
        }
    } catch (const ipc::interprocess_exception& error) {
        errno = error.get_native_error();
    }
    void* address = sparse ? map_sparse(fd, bytes) : MAP_FAILED;
    if (address == MAP_FAILED)
        throw Error(path + ": " + std::to_string(bytes) + " bytes cannot be mapped (" + errno_text() +
                    "); raise the limit on address space or locked memory");
    address_ = static_cast<std::byte*>(address);
}

MappedFile::~MappedFile() {
    if (region_.get_address() == nullptr) ::munmap(address_, size_);
}

} // namespace tandem::shm
