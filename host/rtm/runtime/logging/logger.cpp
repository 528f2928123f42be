// SPDX-License-Identifier: Apache-2.0
// The log of the process: level, files and streams. OpenRTM-aist: class Logger of SystemLogger.h, and
// coil::LogStreambuf. A line has one form, `[date] [level] name: message`, and is never interleaved with
// another. [any-thread]
#include "host/rtm/runtime/logging/logger.hpp"
#include "host/log/log_output.hpp"
#include "host/process/output_file.hpp"
#include "host/text/printable.hpp"
#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <coil/stringutil.h>
#include <ctime>
#include <memory>
#include <rtm/SystemLogger.h>
#include <sstream>
#include <stdexcept>
#include <unistd.h>
#include <vector>

namespace RTC {
namespace {

constexpr std::array<const char*, 9> level_names{"SILENT", "FATAL", "ERROR",   "WARN",    "INFO",
                                                 "DEBUG",  "TRACE", "VERBOSE", "PARANOID"};
std::atomic<int> process_level{Logger::RTL_INFO};

using tandem::log::LogOutput;

// Threads of components with a period log: they wait for no reader.
std::unique_ptr<LogOutput> make_output(int descriptor) {
    return std::make_unique<LogOutput>(descriptor, program_invocation_short_name,
                                       std::chrono::milliseconds(0));
}

// Never deleted, and its files are never closed: components log from static destructors as well.
struct Outputs {
    std::mutex mutex;
    std::vector<std::unique_ptr<LogOutput>> files;
    std::unique_ptr<LogOutput> standard_error; ///< while no file is named
    std::string date_format = "%Y-%m-%d %H:%M:%S.%Q";
};
Outputs& outputs() {
    static auto* the_outputs = new Outputs;
    return *the_outputs;
}

// The current local time. `format` has the codes of strftime(), and %Q for milliseconds, %q for microseconds,
// as in OpenRTM-aist.
std::string format_time(std::string format) {
    timespec t;
    clock_gettime(CLOCK_REALTIME, &t);
    tm local;
    localtime_r(&t.tv_sec, &local);
    format = coil::replaceString(format, "%Q", coil::sprintf("%03ld", t.tv_nsec / 1000000));
    format = coil::replaceString(format, "%q", coil::sprintf("%06ld", t.tv_nsec / 1000));
    char text[128];
    return std::string(text, std::strftime(text, sizeof text, format.c_str(), &local));
}

// Returns -1 if the file cannot be opened. It is never closed.
int open_log_file(const std::string& name) {
    using namespace tandem::process;
    if (name == "stdout") return STDOUT_FILENO;
    if (name == "stderr") return STDERR_FILENO;
    try {
        return open_output(name, Existing::append).release();
    } catch (const std::runtime_error&) {
        return -1; // the caller logs the name
    }
}

} // namespace

// Sets one level for all loggers of the process. Returns false, and leaves the level unchanged, for an unknown name.
bool Logger::setLevel(const char* level) {
    const std::string upper_case = coil::toUpper(coil::eraseBothEndsBlank(level));
    for (std::size_t i = 0; i < level_names.size(); ++i) {
        if (upper_case != level_names[i]) continue;
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

// RTL_SILENT for an unknown name, as in OpenRTM-aist.
int Logger::strToLevel(const char* level) {
    const auto found =
        std::find(level_names.begin(), level_names.end(), coil::toUpper(coil::eraseBothEndsBlank(level)));
    return found == level_names.end() ? RTL_SILENT : static_cast<int>(found - level_names.begin());
}

// Never deleted, like the files.
coil::LogStreamBuffer& Logger::processStreams() {
    static auto* the_streams = new coil::LogStreamBuffer;
    return *the_streams;
}

int Logger::processLevel() { return process_level.load(std::memory_order_relaxed); }

void Logger::setDateFormat(const char* format) {
    std::lock_guard<std::mutex> lock(outputs().mutex);
    outputs().date_format = format;
}

// Opens `stdout`, `stderr` or a file, to which it appends. Returns false if the file cannot be opened.
bool Logger::addOutput(const std::string& file_name) {
    const int file = open_log_file(file_name);
    if (file < 0) return false;
    std::lock_guard<std::mutex> lock(outputs().mutex);
    outputs().files.push_back(make_output(file));
    return true;
}

void report_lost_log_lines() {
    std::lock_guard<std::mutex> lock(outputs().mutex);
    const auto report = [](const std::unique_ptr<LogOutput>& output) {
        if (output && output->missing() > 0) output->write("");
    };
    report(outputs().standard_error);
    for (const auto& file : outputs().files) report(file);
}

// The file lock also orders the lines. Streams are called without it, because a stream may log.
void Logger::write(int level, const std::string& message) const {
    if (level < 0 || level >= static_cast<int>(level_names.size())) return;
    std::string date;
    {
        std::lock_guard<std::mutex> lock(outputs().mutex);
        date = format_time(outputs().date_format);
        const std::string line = tandem::text::printable_text(
            "[" + date + "] [" + coil::toLower(level_names[static_cast<std::size_t>(level)]) + "] " + m_name +
            ": " + message + "\n");
        // OpenRTM-aist writes ./rtc<pid>.log if no file is named. Tandem writes no file unless one is configured.
        auto& standard_error = outputs().standard_error;
        if (outputs().files.empty() && !standard_error) standard_error = make_output(STDERR_FILENO);
        if (outputs().files.empty()) standard_error->write(line);
        for (const auto& file : outputs().files) file->write(line);
    }
    thread_local bool in_stream = false; // lines that a stream logs do not go to streams again
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
