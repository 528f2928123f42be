// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rt/short_mutex.hpp"
#include <new>
#include <rtm/DataMutex.h>

namespace RTC {

/// Returns the mutex inside a DataMutex. A separate mutex would need one more cache line per message.
inline tandem::rt::ShortMutex& short_mutex(DataMutex& mutex) {
    return *std::launder(static_cast<tandem::rt::ShortMutex*>(mutex.memory()));
}

} // namespace RTC
