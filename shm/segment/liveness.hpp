// SPDX-License-Identifier: Apache-2.0
// Tells by byte-range locks on the segment's file which sides live. The locks are of the OFD kind: they belong to the
// open file, not to the process. So two sides may live in one process, processes of several pid namespaces may share a
// segment, and the kernel frees a lock when the last reference to the open file is gone, however its owner ended.
//
// A child process must not be such a reference. So a side holds its lock by an open file of its own (lock_life()), which
// is not mapped, as a mapping is a reference, too. Children that call exec() do not have it (O_CLOEXEC), others close it
// (CloseOnForkDescriptor). The locks of F_SETLK, which no child inherits, will not do: a process loses them when it closes any
// descriptor of the file, as programs that list the segments in /dev/shm do, and does not see its own.
#pragma once
#include "shm/os/close_on_fork_descriptor.hpp"
#include "shm/segment/side.hpp"

#include <chrono>
#include <memory>

namespace tandem::shm {

enum class LockByte : long { first = 0, second = 1, hand_over = 2 };
constexpr LockByte life_byte(Side side) { return side == Side::first ? LockByte::first : LockByte::second; }

/// Locks the byte of a side in the file of `fd`, by an open file of its own, until that is destroyed. Empty if another one has locked
/// it. Throws Error if the file cannot be opened once more.
std::unique_ptr<CloseOnForkDescriptor> lock_life(int fd, Side side);
bool try_lock(int fd, LockByte byte); ///< Locks it if it is free; the file must be open for writing.
void unlock(int fd, LockByte byte);
bool held_by_other(int fd,
                   LockByte byte); ///< Whether another open file has locked it. Makes one system call.

/// Holds the hand-over byte, under which segments are created, joined, left and removed. That takes microseconds:
/// a holder that keeps it for longer than `bound` has been stopped, and the constructor gives up; ask held().
class HandOverLock {
  public:
    explicit HandOverLock(int fd, std::chrono::milliseconds bound = std::chrono::milliseconds(200));
    ~HandOverLock();
    HandOverLock(const HandOverLock&) = delete;
    HandOverLock& operator=(const HandOverLock&) = delete;
    bool held() const { return held_; }

  private:
    int fd_;
    bool held_;
};

} // namespace tandem::shm
