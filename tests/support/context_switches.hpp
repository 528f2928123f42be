// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <sys/types.h>

namespace tandem::test {

/// How often each thread of a process has gone to sleep so far, by the thread's name and number: a thread that is never woken
/// keeps its count. Involuntary switches, when others take its processor, do not count.
inline std::map<std::string, long> count_context_switches(pid_t process) {
    std::map<std::string, long> counts;
    for (const auto& task :
         std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task")) {
        std::ifstream status(task.path() / "status");
        std::string name;
        long count = 0;
        for (std::string line; std::getline(status, line);) {
            const std::string value = line.substr(std::min(line.size(), line.find('\t') + 1));
            if (line.starts_with("Name:")) name = value;
            if (line.starts_with("voluntary_ctxt_switches:")) count = std::stol(value);
        }
        counts[name + " " + task.path().filename().string()] = count;
    }
    return counts;
}

} // namespace tandem::test
