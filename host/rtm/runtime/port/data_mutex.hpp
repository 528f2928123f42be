// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rt/short_mutex.hpp"
#include <new>
#include <rtm/DataMutex.h>

namespace RTC {

/// What a DataMutex consists of: in the object itself, since a mutex elsewhere would be one more cache line for each message.
inline tandem::rt::ShortMutex& short_mutex(DataMutex& mutex) {
    return *std::launder(static_cast<tandem::rt::ShortMutex*>(mutex.memory()));
}

} // namespace RTC
