// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_LOGSTREAMBASE_H
#define RTC_LOGSTREAMBASE_H
#include <coil/Factory.h>
#include <coil/Logger.h>
#include <coil/Properties.h>
#include <rtm/CdrBufferBase.h>
#include <rtm/DataPortStatus.h>
#include <rtm/RTC.h>

namespace RTC {
using StreambufType = coil::LogStreamBuffer;

/// A destination of log lines, from a library (`logger.logstream.<name>` of rtc.conf).
class LogstreamBase {
  public:
    virtual ~LogstreamBase() = default;
    virtual bool init(const coil::Properties& prop) = 0;
    virtual StreambufType* getStreamBuffer() = 0;
};
using LogstreamFactory = coil::GlobalFactory<LogstreamBase>;

} // namespace RTC

extern template class coil::GlobalFactory<RTC::LogstreamBase>;
#endif
