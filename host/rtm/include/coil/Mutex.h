// SPDX-License-Identifier: Apache-2.0
// A name of OpenRTM-aist 1.x.
#ifndef COIL_MUTEX_H
#define COIL_MUTEX_H
#include <pthread.h>

namespace coil {

class Mutex {
  public:
    explicit Mutex(const char* /*name*/ = nullptr) {}
    ~Mutex() { ::pthread_mutex_destroy(&mutex_); }
    Mutex(const Mutex&) = delete;
    Mutex& operator=(const Mutex&) = delete;
    void lock() { ::pthread_mutex_lock(&mutex_); }
    void unlock() { ::pthread_mutex_unlock(&mutex_); }
    /// Returns FALSE if the caller got the lock, as in 1.x.
    bool trylock() { return ::pthread_mutex_trylock(&mutex_) != 0; }
    /// Returns true if the caller got the lock, like std::mutex.
    bool try_lock() { return ::pthread_mutex_trylock(&mutex_) == 0; }

    pthread_mutex_t mutex_ = PTHREAD_MUTEX_INITIALIZER; // components pass it to pthread functions
};

} // namespace coil
#endif
