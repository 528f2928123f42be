// SPDX-License-Identifier: Apache-2.0
// OpenRTM-aist has the interface in Logger.idl. Its module LoggerConsumer accepts the tool and sends nothing.
#include "host/rtm/runtime/sdo/log_publisher.hpp"
#include <algorithm>
#include <array>
#include <coil/stringutil.h>
#include <ctime>

namespace RTC {
namespace {

// OpenRTM::LogLevel, by number.
constexpr std::array<const char*, 9> level_names{"SILENT", "ERROR", "WARN",    "INFO",    "NORMAL",
                                                 "DEBUG",  "TRACE", "VERBOSE", "PARANOID"};
constexpr CORBA::ULong normal = 4;

// A thousand lines may wait for a tool that hangs.
constexpr std::size_t max_text = 16384;

// The level of a tool for a level of Logger, which has FATAL and no NORMAL.
CORBA::ULong tool_level(int level) {
    if (level <= Logger::RTL_FATAL) return 1;
    return static_cast<CORBA::ULong>(level < Logger::RTL_DEBUG ? level - 1 : level);
}

CORBA::ULong read_level(const std::string& name) {
    const auto found =
        std::find(level_names.begin(), level_names.end(), coil::toUpper(coil::eraseBothEndsBlank(name)));
    return found == level_names.end() ? normal : static_cast<CORBA::ULong>(found - level_names.begin());
}

template <class T>
CORBA::Any any_of(T value) {
    CORBA::Any any;
    any <<= value;
    return any;
}

} // namespace

void LogPublisher::start(const coil::Properties& settings) {
    max_level_ = read_level(settings.getProperty("logger.log_level"));
    loggers_ = coil::split(settings.getProperty("logger.filter"), ",", true);
    if (coil::includes(loggers_, "ALL")) loggers_.clear();
    Logger::processStreams().addStream(this);
}

void LogPublisher::stop() { Logger::processStreams().removeStream(this); }

bool LogPublisher::is_wanted(const std::string& name) const {
    if (!loggers_.empty()) return std::find(loggers_.begin(), loggers_.end(), name) != loggers_.end();
    const std::string own = component().getInstanceName();
    return name.compare(0, own.size(), own) == 0 && (name.size() == own.size() || name[own.size()] == '.');
}

// The arguments are the members of OpenRTM::LogRecord.
void LogPublisher::write(int level, const std::string& name, const std::string&, const std::string& message) {
    if (tool_level(level) > max_level_ || !is_wanted(name)) return;
    const std::string text = message.size() <= max_text ? message : message.substr(0, max_text) + "...";
    timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    send("publish",
         {any_of(static_cast<CORBA::ULong>(now.tv_sec)), any_of(static_cast<CORBA::ULong>(now.tv_nsec)),
          any_of(name.c_str()), any_of(tool_level(level)), any_of(text.c_str())});
}

} // namespace RTC
