// SPDX-License-Identifier: Apache-2.0
// Ours.
#ifndef RTC_DATAMUTEX_H
#define RTC_DATAMUTEX_H
#include <memory>
#include <mutex>

namespace RTC {

/// The mutex that data ports hold while they write or read: shorter than std::mutex, and its code lies beside that of
/// the ports. Not recursive. For std::unique_lock. [any-thread]
class DataMutex {
  public:
    DataMutex();
    DataMutex(const DataMutex&) = delete;
    void lock();
    void unlock();
    /// For the ports' own code, which has the same mutex without calls.
    void* memory() { return m_mutex; }
    /// Without waiting, and only for the thread that has used the mutex to itself. Returns whether it has it now.
    bool lockIfOwner();
    /// Makes what the mutex protects, unless it is there. Returns false, without side effects, if lockIfOwner() does.
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
