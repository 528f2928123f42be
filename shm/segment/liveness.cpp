// SPDX-License-Identifier: Apache-2.0
#include "shm/segment/liveness.hpp"

#include "shm/os/clock.hpp"

#include <fcntl.h>
#include <thread>

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
