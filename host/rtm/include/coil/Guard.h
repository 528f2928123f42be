// SPDX-License-Identifier: Apache-2.0
// A name of OpenRTM-aist 1.x.
#ifndef COIL_GUARD_H
#define COIL_GUARD_H

namespace coil {

template <class MutexType>
class Guard {
  public:
    explicit Guard(MutexType& mutex) : mutex_(mutex) { mutex_.lock(); }
    ~Guard() { mutex_.unlock(); }
    Guard(const Guard&) = delete;
    Guard& operator=(const Guard&) = delete;

  private:
    MutexType& mutex_;
};

} // namespace coil
#endif
