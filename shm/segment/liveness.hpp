// SPDX-License-Identifier: Apache-2.0
// Tells by byte-range locks on the segment's file which sides live. The locks are of the OFD kind: they belong to the
// open file, not to the process. So two sides may live in one process, and the kernel frees a lock when the last
// reference to the open file is gone, however its owner ended. A fork()ed child that never calls exec() keeps its
// parent's side alive; children that exec do not (O_CLOEXEC).
#pragma once
#include "shm/segment/side.hpp"

#include <chrono>

namespace tandem::shm {

enum class LockByte : long { first = 0, second = 1, hand_over = 2 };
constexpr LockByte life_byte(Side side) { return side == Side::first ? LockByte::first : LockByte::second; }

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
