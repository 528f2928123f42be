// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_LOGGER_H
#define COIL_LOGGER_H
#include <string>

namespace coil {

/// Where log lines go; a plugin of RTC::LogstreamFactory derives from it. write() may be called by any
/// thread, by one at a time.
class LogStreamBuffer {
  public:
    LogStreamBuffer() = default;
    virtual ~LogStreamBuffer() = default;
    LogStreamBuffer(const LogStreamBuffer&) = delete;
    LogStreamBuffer& operator=(const LogStreamBuffer&) = delete;
    virtual void write(int level, const std::string& name, const std::string& date,
                       const std::string& mes) = 0;
    virtual void flush() {}
};

} // namespace coil
#endif
