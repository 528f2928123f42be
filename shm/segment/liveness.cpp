// SPDX-License-Identifier: Apache-2.0
#include "shm/segment/liveness.hpp"

#include "shm/os/clock.hpp"
#include "shm/segment/layout.hpp"

#include <cstddef>
#include <cstdint>
#include <fcntl.h>
#include <thread>
#include <unistd.h>

namespace tandem::shm {
namespace {

int lock_call(int fd, int command, short type, LockByte byte, struct flock& lock) {
    lock = {};
    lock.l_type = type;
    lock.l_whence = SEEK_SET;
    lock.l_start = static_cast<off_t>(byte);
    lock.l_len = 1;
    return fcntl(fd, command, &lock);
}

} // namespace

std::unique_ptr<CloseOnForkDescriptor> lock_life(int fd, Side side) {
    // Opens by the descriptor, because the name may belong to another file by now.
    auto lock =
        std::make_unique<CloseOnForkDescriptor>("/proc/self/fd/" + std::to_string(fd), O_RDWR | O_CLOEXEC);
    return try_lock(lock->get(), life_byte(side)) ? std::move(lock) : nullptr;
}

bool try_lock(int fd, LockByte byte) {
    struct flock lock;
    return lock_call(fd, F_OFD_SETLK, F_WRLCK, byte, lock) == 0;
}

void unlock(int fd, LockByte byte) {
    struct flock lock;
    lock_call(fd, F_OFD_SETLK, F_UNLCK, byte, lock);
}

bool held_by_other(int fd, LockByte byte) {
    struct flock lock;
    return lock_call(fd, F_OFD_GETLK, F_WRLCK, byte, lock) == 0 && lock.l_type != F_UNLCK;
}

std::optional<ProcessIdentity> read_identity(int fd, Side side) {
    using layout::SegmentHeader;
    using layout::SideHeader;
    struct Words {
        std::uint32_t taken, pid;
        std::uint64_t joined_ns, pid_namespace, time_namespace, start_ticks;
    } words{};
    static_assert(offsetof(SideHeader, taken) == 0 && offsetof(SideHeader, pid) == offsetof(Words, pid) &&
                  offsetof(SideHeader, start_ticks) == offsetof(Words, start_ticks));
    struct Begin {
        std::uint64_t magic;
        std::uint32_t layout_version;
    } begin{};
    static_assert(offsetof(SegmentHeader, layout_version) == offsetof(Begin, layout_version));
    const auto place = sizeof(SegmentHeader) + index_of(side) * sizeof(SideHeader);
    if (pread(fd, &begin, sizeof begin, 0) != sizeof begin || begin.magic != layout::magic ||
        begin.layout_version != layout::layout_version ||
        pread(fd, &words, sizeof words, static_cast<off_t>(place)) != sizeof words || words.taken == 0)
        return std::nullopt;
    return ProcessIdentity{words.pid, words.pid_namespace, words.time_namespace, words.start_ticks};
}

bool process_has_ended(int fd, Side side) {
    const auto process = read_identity(fd, side);
    return process && find_process(*process) == ProcessLookup::ended;
}

bool side_lives(int fd, Side side) {
    return held_by_other(fd, life_byte(side)) && !process_has_ended(fd, side);
}

HandOverLock::HandOverLock(int fd, std::chrono::milliseconds bound)
    : fd_(fd), held_(try_lock(fd, LockByte::hand_over)) {
    const auto deadline = deadline_after(bound);
    while (!held_ && now_ns() < deadline) {
        std::this_thread::sleep_for(std::chrono::microseconds(100));
        held_ = try_lock(fd, LockByte::hand_over);
    }
}

HandOverLock::~HandOverLock() {
    if (held_) unlock(fd_, LockByte::hand_over);
}

} // namespace tandem::shm
