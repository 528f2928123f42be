// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_SYSTEMLOGGER_H
#define RTC_SYSTEMLOGGER_H
#include <coil/Logger.h>
#include <coil/Properties.h>
#include <coil/stringutil.h>
#include <mutex>
#include <rtm/config_rtc.h>
#include <string>

namespace RTC {
using LogStreamBuf = coil::LogStreamBuffer;

/// A named source of log lines. The process determines level and outputs (logger.* of rtc.conf; default: standard
/// error). [any-thread]
class Logger {
  public:
    enum {
        RTL_SILENT,
        RTL_FATAL,
        RTL_ERROR,
        RTL_WARN,
        RTL_INFO,
        RTL_DEBUG,
        RTL_TRACE,
        RTL_VERBOSE,
        RTL_PARANOID
    };

    explicit Logger(const char* name = "") : m_name(name) {}

    /// Sets the level of the process, `SILENT` .. `PARANOID`. Returns false if there is no such level.
    bool setLevel(const char* level);
    void setName(const char* name) { m_name = name; }
    /// Sets the date format of the process: the codes of strftime, %Q for milliseconds, %q for microseconds.
    void setDateFormat(const char* format);
    void setClockType(const std::string&) {}
    bool isValid(int level) const { return level <= processLevel(); }
    void lock() const {}
    void unlock() const {}
    void write(int level, const std::string& message) const;
    void write(int level, const coil::Properties& properties) const;

    /// Returns `RTL_ERROR` ..., or an empty string if the number is not a level.
    static const char* getLevelString(int level);
    /// Returns RTL_SILENT if the name is not a level's name.
    static int strToLevel(const char* level);

    static int processLevel();
    /// Adds a file, `stdout` or `stderr` as an output, which replaces the default, standard error. Returns false if the
    /// file cannot be opened.
    static bool addOutput(const std::string& file_name);
    /// Ours: returns the streams that also get every log line of the process.
    static coil::LogStreamBuffer& processStreams();

  private:
    std::string m_name;
};

} // namespace RTC

// Components use these with and without a semicolon.
#define RTC_LOG(LV, fmt)                                                                                     \
    if (rtclog.isValid(LV)) {                                                                                \
        rtclog.write(LV, ::coil::sprintf fmt);                                                               \
    }
#define RTC_LOG_STR(LV, str)                                                                                 \
    if (rtclog.isValid(LV)) {                                                                                \
        rtclog.write(LV, str);                                                                               \
    }

#define RTC_FATAL(fmt) RTC_LOG(::RTC::Logger::RTL_FATAL, fmt)
#define RTC_FATAL_STR(str) RTC_LOG_STR(::RTC::Logger::RTL_FATAL, str)
#define RTC_ERROR(fmt) RTC_LOG(::RTC::Logger::RTL_ERROR, fmt)
#define RTC_ERROR_STR(str) RTC_LOG_STR(::RTC::Logger::RTL_ERROR, str)
#define RTC_WARN(fmt) RTC_LOG(::RTC::Logger::RTL_WARN, fmt)
#define RTC_WARN_STR(str) RTC_LOG_STR(::RTC::Logger::RTL_WARN, str)
#define RTC_INFO(fmt) RTC_LOG(::RTC::Logger::RTL_INFO, fmt)
#define RTC_INFO_STR(str) RTC_LOG_STR(::RTC::Logger::RTL_INFO, str)
#define RTC_DEBUG(fmt) RTC_LOG(::RTC::Logger::RTL_DEBUG, fmt)
#define RTC_DEBUG_STR(str) RTC_LOG_STR(::RTC::Logger::RTL_DEBUG, str)
#define RTC_TRACE(fmt) RTC_LOG(::RTC::Logger::RTL_TRACE, fmt)
#define RTC_TRACE_STR(str) RTC_LOG_STR(::RTC::Logger::RTL_TRACE, str)
#define RTC_VERBOSE(fmt) RTC_LOG(::RTC::Logger::RTL_VERBOSE, fmt)
#define RTC_VERBOSE_STR(str) RTC_LOG_STR(::RTC::Logger::RTL_VERBOSE, str)
#define RTC_PARANOID(fmt) RTC_LOG(::RTC::Logger::RTL_PARANOID, fmt)
#define RTC_PARANOID_STR(str) RTC_LOG_STR(::RTC::Logger::RTL_PARANOID, str)
#endif
