// SPDX-License-Identifier: Apache-2.0
// Finds the locks in /proc, so that this room needs to know nothing about segments.
#include "host/crash/held_locks.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <string_view>
#include <sys/syscall.h>
#include <unistd.h>

namespace tandem::crash {
namespace {

/// The beginning of an entry of getdents64(2). The name follows `type` without padding.
struct Entry {
    std::uint64_t inode;
    std::int64_t offset;
    std::uint16_t bytes;
    std::uint8_t type;
};
constexpr std::size_t name_offset = 19;

/// proc(5): fdinfo/N has a line `lock: 1: OFDLCK ...` for each lock that the open file holds.
bool holds_lock(int folder, const char* descriptor) {
    const int file = openat(folder, descriptor, O_RDONLY | O_CLOEXEC);
    if (file < 0) return false;
    std::array<char, 2048> text;
    const ssize_t size = read(file, text.data(), text.size());
    close(file);
    const std::string_view info(text.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
    return info.find(" OFDLCK ") != info.npos;
}

/// Returns -1 for the entries `.` and `..`.
int number_of(const char* name) {
    int number = 0;
    for (; *name != 0; ++name) {
        if (*name < '0' || *name > '9') return -1;
        number = 10 * number + (*name - '0');
    }
    return number;
}

void close_locked(int folder, const char* name) {
    const int descriptor = number_of(name);
    if (descriptor >= 0 && descriptor != folder && holds_lock(folder, name)) close(descriptor);
}

} // namespace

void give_up_locks() {
    // opendir() would allocate. /proc/self shows no descriptors once the main thread has ended.
    const int folder = open("/proc/thread-self/fdinfo", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return;
    std::array<char, 4096> entries;
    for (;;) {
        const long size = syscall(SYS_getdents64, folder, entries.data(), entries.size());
        if (size <= 0) break;
        for (long at = 0; at < size;) {
            Entry entry;
            std::memcpy(&entry, entries.data() + at, name_offset);
            close_locked(folder, entries.data() + at + name_offset);
            at += entry.bytes;
        }
    }
    close(folder);
}

} // namespace tandem::crash
