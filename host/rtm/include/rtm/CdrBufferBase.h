// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_CDRBUFFERBASE_H
#define RTC_CDRBUFFERBASE_H
#include <coil/Factory.h>
#include <rtm/BufferBase.h>
#include <rtm/ByteData.h>
#include <rtm/RTC.h>

namespace RTC {
using CdrBufferBase = BufferBase<ByteData>;
/// Buffers from libraries, by name. A connection whose `dataport.buffer_type` (or `dataport.inport.buffer_type`)
/// names one gets its own buffer on the InPort's side.
using CdrBufferFactory = ::coil::GlobalFactory<CdrBufferBase>;
} // namespace RTC

extern template class coil::GlobalFactory<RTC::CdrBufferBase>;
#endif
