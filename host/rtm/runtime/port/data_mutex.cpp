// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/port/data_mutex.hpp"

#include <type_traits>

namespace RTC {

using tandem::rt::ShortMutex;
static_assert(std::is_trivially_destructible_v<ShortMutex>);

DataMutex::DataMutex() {
    static_assert(sizeof(ShortMutex) == sizeof m_mutex && alignof(ShortMutex) == alignof(void*));
    new (m_mutex) ShortMutex;
}

void DataMutex::lock() { short_mutex(*this).lock(); }
bool DataMutex::lockIfOwner() { return short_mutex(*this).lock_if_owner(); }
void DataMutex::unlock() { short_mutex(*this).unlock(); }

} // namespace RTC
