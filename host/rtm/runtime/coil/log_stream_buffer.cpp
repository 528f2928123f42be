// SPDX-License-Identifier: Apache-2.0
// The default LogStreamBuffer: passes log lines on to a list of streams.
#include <algorithm>
#include <coil/Logger.h>

namespace coil {

// The second of each entry is `cleanup`: the stream is deleted with this object.
LogStreamBuffer::~LogStreamBuffer() {
    for (const auto& entry : m_streams)
        if (entry.second) delete entry.first;
}

void LogStreamBuffer::addStream(LogStreamBuffer* stream, bool cleanup) {
    std::lock_guard<std::recursive_mutex> lock(m_mutex);
    m_streams.emplace_back(stream, cleanup);
}

bool LogStreamBuffer::removeStream(LogStreamBuffer* stream) {
    std::lock_guard<std::recursive_mutex> lock(m_mutex);
    const auto found = std::find_if(m_streams.begin(), m_streams.end(),
                                    [&](const auto& entry) { return entry.first == stream; });
    if (found == m_streams.end()) return false;
    if (found->second) delete found->first;
    m_streams.erase(found);
    return true;
}

std::vector<LogStreamBuffer*> LogStreamBuffer::getBuffers() {
    std::lock_guard<std::recursive_mutex> lock(m_mutex);
    std::vector<LogStreamBuffer*> streams;
    for (const auto& entry : m_streams) streams.push_back(entry.first);
    return streams;
}

// With the mutex held, so that streams get one line at a time and removeStream() waits for a write under way.
// Over a copy of the list: a stream's write() may add or remove streams in this thread.
void LogStreamBuffer::write(int level, const std::string& name, const std::string& date,
                            const std::string& mes) {
    std::lock_guard<std::recursive_mutex> lock(m_mutex);
    for (auto* stream : getBuffers()) stream->write(level, name, date, mes);
}

void LogStreamBuffer::flush() {
    std::lock_guard<std::recursive_mutex> lock(m_mutex);
    for (auto* stream : getBuffers()) stream->flush();
}

} // namespace coil
