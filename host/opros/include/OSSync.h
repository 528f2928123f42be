// SPDX-License-Identifier: Apache-2.0
#ifndef OS_SYNC_H_
#define OS_SYNC_H_

#include <OSSetting.h>

/// Base class of locks.
class OSSync {
  public:
    virtual ~OSSync() {}
    /// Waits at most `ms` milliseconds; 0: forever. Returns false if it did not get the lock.
    virtual bool lock(unsigned long ms = 0) = 0;
    virtual bool tryLock() = 0;
    virtual bool unlock() = 0;
};

#endif
