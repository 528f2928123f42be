// SPDX-License-Identifier: Apache-2.0
// Memory that a test shares with its children, outside of what is tested.
#pragma once
#include <boost/interprocess/anonymous_shared_memory.hpp>
#include <new>

namespace tandem::shm::test {

/// One T, alive in this process and all children forked after it was made.
template <class T>
class Shared {
  public:
    T* operator->() const { return static_cast<T*>(region_.get_address()); }
    T& operator*() const { return *operator->(); }

  private:
    static boost::interprocess::mapped_region made() {
        auto region = boost::interprocess::anonymous_shared_memory(sizeof(T));
        new (region.get_address()) T();
        return region;
    }
    boost::interprocess::mapped_region region_ = made();
};

} // namespace tandem::shm::test
