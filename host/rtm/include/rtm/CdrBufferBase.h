// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_CDRBUFFERBASE_H
#define RTC_CDRBUFFERBASE_H
#include <coil/Factory.h>
#include <rtm/BufferBase.h>
#include <rtm/ByteData.h>
#include <rtm/RTC.h>

namespace RTC {
using CdrBufferBase = BufferBase<ByteData>;
/// A connector whose property `dataport.buffer_type` (or `dataport.inport.buffer_type`) names a factory added
/// here gets a buffer of its own from it on the InPort side.
using CdrBufferFactory = ::coil::GlobalFactory<CdrBufferBase>;
} // namespace RTC

extern template class coil::GlobalFactory<RTC::CdrBufferBase>;
#endif
