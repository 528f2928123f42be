// SPDX-License-Identifier: Apache-2.0
// Life and death by byte-range locks on the segment's file, of the OFD kind: they belong to the open file,
// not to the process, so two sides may live in one process, and the kernel frees them when the last reference
// to that open file is gone, however its owner ended. A fork()ed child that never calls exec() shares the
// open file and so keeps its parent's side alive; children that exec do not (O_CLOEXEC).
#pragma once
#include "shm/segment/side.hpp"

#include <chrono>

namespace tandem::shm {

/// The bytes that are locked.
enum class LockByte : long { first = 0, second = 1, hand_over = 2 };
constexpr LockByte life_of(Side side) { return side == Side::first ? LockByte::first : LockByte::second; }

bool try_lock(int fd, LockByte byte);      ///< Takes it if it is free; the file must be open for writing.
void unlock(int fd, LockByte byte);        ///< Gives it back.
bool held_by_other(int fd, LockByte byte); ///< Does another open file hold it? One system call.

/// Holds the hand-over byte: whoever creates, joins, leaves or removes a segment does so under it. It is
/// held for microseconds, so the constructor gives up after `bound` (its holder must have been stopped); ask
/// held().
class HandOver {
  public:
    explicit HandOver(int fd, std::chrono::milliseconds bound = std::chrono::milliseconds(200));
    ~HandOver();
    HandOver(const HandOver&) = delete;
    HandOver& operator=(const HandOver&) = delete;
    bool held() const { return held_; }

  private:
    int fd_;
    bool held_;
};

} // namespace tandem::shm
