// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/engine/rtm_api.hpp"

#ifndef TANDEM_RTM_PUBLIC_API
#include <rtm/InPlaceBuffer.h>
#endif

namespace tandem::interceptor::engine {

#ifdef TANDEM_RTM_PUBLIC_API
/// A buffer of a connector, for messages in ByteData.
using BufferBase = RTC::CdrBufferBase;
#else
/// A buffer of a connector, whose messages may also be encoded and decoded in its own memory.
class BufferBase : public RTC::CdrBufferBase, public RTC::InPlaceBuffer {};
#endif

} // namespace tandem::interceptor::engine
