// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_LOGGER_H
#define COIL_LOGGER_H
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace coil {

/// A destination of log lines. A library's log stream (RTC::LogstreamFactory) derives from it and overrides write().
/// This class forwards lines to its added streams. write() is called in any thread, by one thread at a time.
class LogStreamBuffer {
  public:
    LogStreamBuffer() = default;
    virtual ~LogStreamBuffer();
    LogStreamBuffer(const LogStreamBuffer&) = delete;
    LogStreamBuffer& operator=(const LogStreamBuffer&) = delete;

    /// `cleanup`: the stream is deleted with this one or when it is removed.
    void addStream(LogStreamBuffer* stream, bool cleanup = false);
    /// Returns false if the stream is not in the list. After the call, the stream is not used any more.
    bool removeStream(LogStreamBuffer* stream);
    std::vector<LogStreamBuffer*> getBuffers();

    virtual void write(int level, const std::string& name, const std::string& date, const std::string& mes);
    virtual void flush();

  private:
    std::recursive_mutex m_mutex;
    std::vector<std::pair<LogStreamBuffer*, bool>> m_streams;
};

} // namespace coil
#endif
