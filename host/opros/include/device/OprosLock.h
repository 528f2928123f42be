// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_OPROSLOCK_H_
#define DEVICE_OPROSLOCK_H_

#include <mutex>

/// A lock that its holder may take again. Copying an object that has one gives the copy a lock of its own.
class OprosLock {
  public:
    OprosLock() {}
    OprosLock(const OprosLock&) {}
    OprosLock& operator=(const OprosLock&) { return *this; }
    virtual ~OprosLock() {}
    void Lock() { m_mutex.lock(); }
    void Unlock() { m_mutex.unlock(); }

  private:
    std::recursive_mutex m_mutex;
};

#endif
