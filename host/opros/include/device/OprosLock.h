// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_OPROSLOCK_H_
#define DEVICE_OPROSLOCK_H_

#include <pthread.h>

/// A recursive lock. Copying an object that contains one gives the copy a new lock. Uses POSIX, because <mutex> would
/// bring std::mutex, which clashes with components' own names.
class OprosLock {
  public:
    OprosLock() {
        pthread_mutexattr_t recursive;
        pthread_mutexattr_init(&recursive);
        pthread_mutexattr_settype(&recursive, PTHREAD_MUTEX_RECURSIVE);
        pthread_mutex_init(&m_mutex, &recursive);
        pthread_mutexattr_destroy(&recursive);
    }
    OprosLock(const OprosLock&) : OprosLock() {}
    OprosLock& operator=(const OprosLock&) { return *this; }
    virtual ~OprosLock() { pthread_mutex_destroy(&m_mutex); }
    void Lock() { pthread_mutex_lock(&m_mutex); }
    void Unlock() { pthread_mutex_unlock(&m_mutex); }

  private:
    pthread_mutex_t m_mutex;
};

#endif
