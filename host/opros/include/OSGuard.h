// SPDX-License-Identifier: Apache-2.0
#ifndef OS_GUARD_H_
#define OS_GUARD_H_

#include <OSSync.h>

/// Holds a lock as long as it lives; NULL: none. isLocked() tells whether it got it.
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
