// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <atomic>
#include <coil/stringutil.h>
#include <cstdio>
#include <ctime>
#include <memory>
#include <rtm/SystemLogger.h>
#include <sstream>
#include <vector>

namespace RTC {
namespace {

constexpr std::array<const char*, 9> level_names{"SILENT", "FATAL", "ERROR",   "WARN",    "INFO",
                                                 "DEBUG",  "TRACE", "VERBOSE", "PARANOID"};
std::atomic<int> process_level{Logger::RTL_INFO};

// Files stay open to the end of the process: components log from their destructors, too.
struct Outputs {
    std::mutex mutex;
    std::vector<std::FILE*> files;
    std::string date_format = "%Y-%m-%d %H:%M:%S.%Q";
};
Outputs& outputs() {
    static auto* the_outputs = new Outputs;
    return *the_outputs;
}

// strftime's codes, and %Q milliseconds, %q microseconds.
std::string now(std::string format) {
    timespec t;
    clock_gettime(CLOCK_REALTIME, &t);
    tm local;
    localtime_r(&t.tv_sec, &local);
    format = coil::replaceString(format, "%Q", coil::sprintf("%03ld", t.tv_nsec / 1000000));
    format = coil::replaceString(format, "%q", coil::sprintf("%06ld", t.tv_nsec / 1000));
    char text[128];
    return std::string(text, std::strftime(text, sizeof text, format.c_str(), &local));
}

} // namespace

bool Logger::setLevel(const char* level) {
    const std::string wanted = coil::toUpper(coil::eraseBothEndsBlank(level));
    for (std::size_t i = 0; i < level_names.size(); ++i) {
        if (wanted != level_names[i]) continue;
        process_level = static_cast<int>(i);
        return true;
    }
    return false;
}

const char* Logger::getLevelString(int level) {
    static const char* const names[] = {"RTL_SILENT", "RTL_FATAL", "RTL_ERROR",   "RTL_WARN",    "RTL_INFO",
                                        "RTL_DEBUG",  "RTL_TRACE", "RTL_VERBOSE", "RTL_PARANOID"};
    return level >= 0 && level < static_cast<int>(level_names.size()) ? names[level] : "";
}

int Logger::strToLevel(const char* level) {
    const auto found =
        std::find(level_names.begin(), level_names.end(), coil::toUpper(coil::eraseBothEndsBlank(level)));
    return found == level_names.end() ? RTL_SILENT : static_cast<int>(found - level_names.begin());
}

// Stays to the end of the process, like the files.
coil::LogStreamBuffer& Logger::processStreams() {
    static auto* the_streams = new coil::LogStreamBuffer;
    return *the_streams;
}

int Logger::processLevel() { return process_level.load(std::memory_order_relaxed); }

void Logger::setDateFormat(const char* format) {
    std::lock_guard<std::mutex> lock(outputs().mutex);
    outputs().date_format = format;
}

bool Logger::addOutput(const std::string& file_name) {
    std::FILE* file = file_name == "stdout"   ? stdout
                      : file_name == "stderr" ? stderr
                                              : std::fopen(file_name.c_str(), "a");
    if (file == nullptr) return false;
    std::lock_guard<std::mutex> lock(outputs().mutex);
    outputs().files.push_back(file);
    return true;
}

void Logger::write(int level, const std::string& message) const {
    if (level < 0 || level >= static_cast<int>(level_names.size())) return;
    std::string date;
    {
        std::lock_guard<std::mutex> lock(outputs().mutex);
        date = now(outputs().date_format);
        const std::string line = "[" + date + "] [" +
                                 coil::toLower(level_names[static_cast<std::size_t>(level)]) + "] " + m_name +
                                 ": " + message + "\n";
        if (outputs().files.empty()) std::fputs(line.c_str(), stderr);
        for (std::FILE* file : outputs().files) {
            std::fputs(line.c_str(), file);
            std::fflush(file);
        }
    }
    thread_local bool in_stream = false; // a stream that logs does not hear itself
    if (in_stream) return;
    in_stream = true;
    processStreams().write(level, m_name, date, message);
    in_stream = false;
}

void Logger::write(int level, const coil::Properties& properties) const {
    std::ostringstream text;
    text << properties;
    write(level, text.str());
}

} // namespace RTC
