// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/control/host_logs.hpp"

#include "apps/tandem/monitor/host_files/process_files.hpp"
#include "host/process/file_descriptor.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <string>

namespace tandem::monitor {
namespace {

constexpr std::size_t max_chunk = 64 << 10, max_logs = 16;

struct Log {
    process::FileDescriptor file;
    std::uint64_t bytes = 0;
    std::set<std::string> hosts;
};

/// Returns the parent if it is `tandem`, which writes what its hosts write; else 0.
int tandem_above(std::uint32_t pid) {
    std::ifstream status(fmt::format("/proc/{}/status", pid));
    int parent = 0;
    for (std::string word; status >> word;)
        if (word == "PPid:") {
            status >> parent;
            break;
        }
    return program_of(static_cast<std::uint32_t>(parent)) == "tandem" ? parent : 0;
}

/// Adds the standard error of a process to the logs if it is a file of this user. Never opens a
/// pipe, because this process would become its reader.
bool add_log(std::uint32_t pid, const std::string& host, std::map<std::string, Log>& logs) {
    const std::string path = fmt::format("/proc/{}/fd/2", pid);
    struct stat status {};
    if (stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return false;
    process::FileDescriptor file(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    // The process may have another file by now.
    if (file.get() < 0 || fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode) ||
        status.st_uid != geteuid())
        return false;
    const std::string id = fmt::format("{}-{}", status.st_dev, status.st_ino);
    if (const auto known = logs.find(id); known != logs.end()) {
        known->second.hosts.insert(host);
        return true;
    }
    if (logs.size() >= max_logs) return false;
    logs[id] = {std::move(file), static_cast<std::uint64_t>(status.st_size), {host}};
    return true;
}

nlohmann::json read_log(const std::string& id, const Log& log, const nlohmann::json& from) {
    std::uint64_t at = log.bytes > max_chunk ? log.bytes - max_chunk : 0;
    bool begins_with_line = at == 0;
    if (const auto known = from.find(id); known != from.end() && known->is_number_unsigned()) {
        begins_with_line = true;
        at = known->get<std::uint64_t>();
        if (at > log.bytes) at = 0; // the file was emptied
    }
    std::string text(max_chunk, '\0');
    const auto bytes = pread(log.file.get(), text.data(), text.size(), static_cast<off_t>(at));
    text.resize(bytes < 0 ? 0 : static_cast<std::size_t>(bytes));
    const std::size_t end = text.rfind('\n');
    if (end != std::string::npos || text.size() < max_chunk)
        text.resize(end == std::string::npos ? 0 : end + 1);
    const std::uint64_t next = at + text.size();
    if (!begins_with_line) text.erase(0, std::min(text.find('\n'), text.size() - 1) + 1);
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' && c != '\n'; },
        '?');
    return {{"id", id}, {"hosts", log.hosts}, {"text", text}, {"next", next}};
}

} // namespace

nlohmann::json read_host_logs(const State& state, const nlohmann::json& from) {
    std::map<std::string, Log> logs;
    for (const auto& [pid, program] : running_hosts(state)) {
        const std::string host = fmt::format("{} {}", program, pid);
        if (add_log(pid, host, logs)) continue;
        if (const int above = tandem_above(pid); above > 0)
            add_log(static_cast<std::uint32_t>(above), host, logs);
    }
    nlohmann::json list = nlohmann::json::array();
    for (const auto& [id, log] : logs) list.push_back(read_log(id, log, from));
    return list;
}

} // namespace tandem::monitor
