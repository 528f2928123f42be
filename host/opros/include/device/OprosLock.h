// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_OPROSLOCK_H_
#define DEVICE_OPROSLOCK_H_

#include <pthread.h>

/// A lock that its holder may take again. Copying an object that has one gives the copy a lock of its own.
/// Of POSIX: with <mutex>, std::mutex would clash with a component's own name.
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
