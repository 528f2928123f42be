// SPDX-License-Identifier: Apache-2.0
// Ours.
#ifndef RTC_DATAMUTEX_H
#define RTC_DATAMUTEX_H
#include <memory>
#include <mutex>

namespace RTC {

/// The mutex that data ports hold while they write or read. Faster than std::mutex; its code is close to the ports'
/// code. Not recursive. Works with std::unique_lock. [any-thread]
class DataMutex {
  public:
    DataMutex();
    DataMutex(const DataMutex&) = delete;
    void lock();
    void unlock();
    /// For the ports' own code, which uses this mutex without function calls.
    void* memory() { return m_mutex; }
    /// Locks without waiting, only for the thread that owns the mutex. Returns true if the thread now holds it.
    bool lockIfOwner();
    /// Creates the object that the mutex protects, unless it exists. Returns false, without side effects, if
    /// lockIfOwner() does.
    template <class Object>
    bool makeIfOwner(std::unique_ptr<Object>& object) {
        if (!lockIfOwner()) return false;
        const std::unique_lock<DataMutex> lock(*this, std::adopt_lock);
        if (!object) object = std::make_unique<Object>();
        return true;
    }

  private:
    alignas(void*) unsigned char m_mutex[4 * sizeof(void*)];
};

} // namespace RTC
#endif
