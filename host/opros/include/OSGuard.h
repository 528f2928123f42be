// SPDX-License-Identifier: Apache-2.0
#ifndef OS_GUARD_H_
#define OS_GUARD_H_

#include <OSSync.h>

/// Holds a lock during its lifetime; NULL: no lock. isLocked() returns true if it got the lock.
class OSGuard {
  public:
    explicit OSGuard(OSSync* sync) : m_sync(sync), m_isLocked(sync && sync->lock()) {}
    virtual ~OSGuard() {
        if (m_isLocked) m_sync->unlock();
    }
    bool isLocked() const { return m_isLocked; }

  private:
    OSGuard(const OSGuard&);
    OSGuard& operator=(const OSGuard&);
    OSSync* m_sync;
    bool m_isLocked;
};

#endif
