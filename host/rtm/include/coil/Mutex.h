// SPDX-License-Identifier: Apache-2.0
// Name of OpenRTM-aist 1.x.
#ifndef COIL_MUTEX_H
#define COIL_MUTEX_H
#include <mutex>

namespace coil {

class Mutex {
public:
    explicit Mutex(const char* /*name*/ = nullptr) {}
    void lock() { mutex_.lock(); }
    bool trylock() { return mutex_.try_lock(); }
    bool try_lock() { return mutex_.try_lock(); }
    void unlock() { mutex_.unlock(); }
    std::mutex& native() { return mutex_; }

private:
    std::mutex mutex_;
};

} // namespace coil
#endif
