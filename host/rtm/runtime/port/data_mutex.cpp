// SPDX-License-Identifier: Apache-2.0
#include "host/rt/short_mutex.hpp"
#include <new>
#include <rtm/DataMutex.h>
#include <type_traits>

namespace RTC {
namespace {

using tandem::rt::ShortMutex;
static_assert(std::is_trivially_destructible_v<ShortMutex>);

// In the object itself: a mutex elsewhere would be one more cache line for each message.
ShortMutex& mutex_in(unsigned char* memory) { return *std::launder(reinterpret_cast<ShortMutex*>(memory)); }

} // namespace

DataMutex::DataMutex() {
    static_assert(sizeof(ShortMutex) == sizeof m_mutex && alignof(ShortMutex) == alignof(void*));
    new (m_mutex) ShortMutex;
}

[[gnu::hot]] void DataMutex::lock() { mutex_in(m_mutex).lock(); }
bool DataMutex::lockIfOwner() { return mutex_in(m_mutex).lock_if_owner(); }
[[gnu::hot]] void DataMutex::unlock() { mutex_in(m_mutex).unlock(); }

} // namespace RTC
