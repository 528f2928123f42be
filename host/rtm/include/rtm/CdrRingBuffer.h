// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_CDRRINGBUFFER_H
#define RTC_CDRRINGBUFFER_H
#include <rtm/CdrBufferBase.h>
#include <rtm/RingBuffer.h>

namespace RTC {
using CdrRingBuffer = RingBuffer<ByteData>;
} // namespace RTC
#endif
