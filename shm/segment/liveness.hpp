// SPDX-License-Identifier: Apache-2.0
// Byte-range locks on the segment's file show which sides are alive. They are OFD locks: they belong to the open file, not
// to the process. Therefore two sides may live in one process, processes of several pid namespaces may share a segment, and
// the kernel frees a lock when the last reference to the open file is gone, however its owner ended.
//
// A child process must not hold such a reference. So each side opens the file once more for its lock (lock_life()), and
// does not map that open file, because a mapping is a reference, too. Children that call exec() do not inherit it (O_CLOEXEC),
// other children close it (CloseOnForkDescriptor). Children of clone(2) and _Fork(3) keep it. So a side is alive only while
// its lock is held and its process, if that belongs to this pid namespace, has not ended (side_lives()). F_SETLK locks,
// which no child inherits, are unsuitable: a process loses them when it closes any descriptor of the file, as programs that
// list /dev/shm do, and does not see its own locks.
#pragma once
#include "shm/os/close_on_fork_descriptor.hpp"
#include "shm/segment/process_identity.hpp"
#include "shm/segment/side.hpp"

#include <chrono>
#include <memory>
#include <optional>

namespace tandem::shm {

enum class LockByte : long { first = 0, second = 1, hand_over = 2 };
constexpr LockByte life_byte(Side side) { return side == Side::first ? LockByte::first : LockByte::second; }

/// Locks the byte of a side through a newly opened file, until the returned object is destroyed. Returns nullptr if another
/// open file has locked the byte. Throws Error if the file cannot be opened again.
std::unique_ptr<CloseOnForkDescriptor> lock_life(int fd, Side side);
bool try_lock(int fd, LockByte byte); ///< Locks the byte if it is free. The file must be open for writing.
void unlock(int fd, LockByte byte);
bool held_by_other(
    int fd,
    LockByte byte); ///< Returns whether another open file has locked the byte. Makes one system call.

/// Returns the process that a side of the segment in the open file has named; nothing before the side has joined, and for
/// a file that is not a segment of this layout.
std::optional<ProcessIdentity> read_identity(int fd, Side side);

/// [any-process] Returns whether the process that a side of the segment in the open file has named is known to have ended.
/// Makes up to nine system calls.
bool process_has_ended(int fd, Side side);

/// [any-process] Returns whether a side lives in the segment in the open file: its lock is held, and not only by a child
/// process that outlives it. Makes up to ten system calls.
bool side_lives(int fd, Side side);

/// Holds the hand-over byte, under which segments are created, joined, left and removed. That takes microseconds. If another
/// holder keeps the byte for longer than `bound`, it has been stopped, and the constructor gives up: call held().
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
