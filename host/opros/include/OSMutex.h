// SPDX-License-Identifier: Apache-2.0
#ifndef OS_MUTEX_H_
#define OS_MUTEX_H_

#include <OSSync.h>

#include <chrono>
#include <mutex>

/// A recursive mutex. init() and destroy() exist because upstream has them, and do nothing.
class OSMutex : public OSSync {
  public:
    explicit OSMutex(bool isInit = true) { static_cast<void>(isInit); }
    bool init() { return true; }
    bool destroy() { return true; }
    virtual bool lock(unsigned long ms = 0) {
        if (ms != 0) return m_mutex.try_lock_for(std::chrono::milliseconds(ms));
        m_mutex.lock();
        return true;
    }
    virtual bool tryLock() { return m_mutex.try_lock(); }
    virtual bool unlock() {
        m_mutex.unlock();
        return true;
    }

  private:
    std::recursive_timed_mutex m_mutex;
};

#endif
