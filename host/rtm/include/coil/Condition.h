// SPDX-License-Identifier: Apache-2.0
// A name of OpenRTM-aist 1.x.
#ifndef COIL_CONDITION_H
#define COIL_CONDITION_H
#include <chrono>
#include <condition_variable>

namespace coil {

/// The caller must hold the mutex when it calls wait().
template <class MutexType>
class Condition {
  public:
    explicit Condition(MutexType& mutex) : mutex_(mutex) {}
    void signal() { condition_.notify_one(); }
    void broadcast() { condition_.notify_all(); }
    bool wait() {
        condition_.wait(mutex_);
        return true;
    }
    bool wait(long seconds, long nanoseconds = 0) {
        auto bound = std::chrono::seconds(seconds) + std::chrono::nanoseconds(nanoseconds);
        return condition_.wait_for(mutex_, bound) == std::cv_status::no_timeout;
    }

  private:
    MutexType& mutex_;
    std::condition_variable_any condition_;
};

} // namespace coil
#endif
