// SPDX-License-Identifier: Apache-2.0
// A POSIX shared memory object for components that share memory among themselves. Tandem itself does not use it.
#include <coil/SharedMemory.h>
#include <cstring>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace coil {
namespace {

// All users share /dev/shm: another one may have made an object of this name before.
bool is_own(int descriptor, struct stat& state) {
    return ::fstat(descriptor, &state) == 0 && state.st_uid == ::geteuid();
}

} // namespace

// The creator of the object removes its name. Mappings of other processes stay valid until these close them.
SharedMemory::~SharedMemory() {
    SharedMemory::close();
    if (m_created) SharedMemory::unlink();
}

// Maps the object and closes the descriptor, which the mapping does not need.
int SharedMemory::map(int descriptor, unsigned long long size, const std::string& address) {
    void* data = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    ::close(descriptor);
    if (data == MAP_FAILED) return -1;
    m_data = static_cast<char*>(data);
    m_size = size;
    m_address = address;
    return 0;
}

// Opens the object when it exists already, and sets its size: the form of OpenRTM-aist's.
// NOLINTNEXTLINE(performance-unnecessary-value-param): signature of OpenRTM-aist
int SharedMemory::create(std::string shm_address, unsigned long long memory_size) {
    SharedMemory::close();
    const int descriptor = ::shm_open(shm_address.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (descriptor < 0) return -1;
    struct stat state {};
    if (memory_size == 0 || !is_own(descriptor, state) ||
        ::ftruncate(descriptor, static_cast<off_t>(memory_size)) != 0) {
        ::close(descriptor);
        return -1;
    }
    if (map(descriptor, memory_size, shm_address) != 0) return -1;
    m_created = true;
    return 0;
}

// The object must have been created, with at least that size.
// NOLINTNEXTLINE(performance-unnecessary-value-param): signature of OpenRTM-aist
int SharedMemory::open(std::string shm_address, unsigned long long memory_size) {
    SharedMemory::close();
    const int descriptor = ::shm_open(shm_address.c_str(), O_RDWR | O_CLOEXEC, 0);
    if (descriptor < 0) return -1;
    struct stat state {};
    // Access beyond the object's end would raise SIGBUS.
    if (!is_own(descriptor, state) || memory_size == 0 ||
        static_cast<unsigned long long>(state.st_size) < memory_size) {
        ::close(descriptor);
        return -1;
    }
    return map(descriptor, memory_size, shm_address);
}

// Checks bounds. The caller must prevent two processes from writing at the same time.
int SharedMemory::write(const char* data, unsigned long long pos, unsigned long long size) {
    if (!within(pos, size)) return -1;
    std::memcpy(m_data + pos, data, size);
    return 0;
}

int SharedMemory::read(char* data, unsigned long long pos, unsigned long long size) {
    if (!within(pos, size)) return -1;
    std::memcpy(data, m_data + pos, size);
    return 0;
}

// Without an open object it does nothing and returns 0.
int SharedMemory::close() {
    if (m_data == nullptr) return 0;
    const int result = ::munmap(m_data, m_size);
    m_data = nullptr;
    m_size = 0;
    return result;
}

// Removes the name: existing mappings stay, the next create() makes a new object.
int SharedMemory::unlink() {
    m_created = false;
    return ::shm_unlink(m_address.c_str());
}

} // namespace coil
