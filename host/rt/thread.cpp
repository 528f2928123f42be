// SPDX-License-Identifier: Apache-2.0
#include "host/rt/thread.hpp"

#include "host/process/published/notices.hpp"

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

namespace tandem::rt {
namespace {

std::string error_text(int error) { return std::strerror(error); }

std::string refused(std::string line) {
    process::publish_notice(process::NoticeKind::setting, line);
    return line;
}

// The kernel refuses names of more than 15 characters.
void set_name(const std::string& name) {
    if (!name.empty()) pthread_setname_np(pthread_self(), name.substr(0, 15).c_str());
}

std::optional<std::string> set_priority(const ThreadOptions& options) {
    sched_param parameters{};
    parameters.sched_priority = options.fifo_priority;
    const int error =
        pthread_setschedparam(pthread_self(), options.round_robin ? SCHED_RR : SCHED_FIFO, &parameters);
    if (error == 0) return std::nullopt;
    return refused("thread " + options.name + " runs without " +
                   (options.round_robin ? "SCHED_RR" : "SCHED_FIFO") + " priority " +
                   std::to_string(options.fifo_priority) + ": " + error_text(error) +
                   "; grant CAP_SYS_NICE or an rtprio limit");
}

} // namespace

std::optional<std::string> pin_this_thread(const std::string& who, int cpu) {
    return pin_this_thread(who, std::vector<int>{cpu});
}

std::optional<std::string> pin_this_thread(const std::string& who, const std::vector<int>& cpus) {
    cpu_set_t set;
    CPU_ZERO(&set);
    std::string names;
    bool possible = !cpus.empty();
    for (const int cpu : cpus) {
        names += (names.empty() ? "" : ", ") + std::to_string(cpu);
        if (cpu < 0 || cpu >= CPU_SETSIZE)
            possible = false;
        else
            CPU_SET(static_cast<std::size_t>(cpu), &set);
    }
    const int error = possible ? pthread_setaffinity_np(pthread_self(), sizeof set, &set) : EINVAL;
    if (error == 0) return std::nullopt;
    return refused(who + " is not pinned to processor " + names + ": " + error_text(error) +
                   "; choose one of `taskset -cp $$`");
}

std::vector<std::string> configure_this_thread(const ThreadOptions& options) {
    std::vector<std::string> notices;
    set_name(options.name);
    prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
    if (options.fifo_priority > 0)
        if (auto notice = set_priority(options)) notices.push_back(std::move(*notice));
    if (options.cpu >= 0)
        if (auto notice = pin_this_thread("thread " + options.name, options.cpu))
            notices.push_back(std::move(*notice));
    return notices;
}

std::optional<std::string> lock_memory() {
    if (mlockall(MCL_CURRENT | MCL_FUTURE) == 0) return std::nullopt;
    return refused("memory is not locked: " + error_text(errno) +
                   "; grant CAP_IPC_LOCK or raise `ulimit -l`");
}

std::optional<std::string> hold_low_latency_idle() {
    // The kernel honours the request while the file is open, so the file is never closed.
    const int file = ::open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC);
    const std::int32_t microseconds = 0;
    if (file >= 0 && ::write(file, &microseconds, sizeof microseconds) == sizeof microseconds)
        return std::nullopt;
    const std::string reason = error_text(errno);
    if (file >= 0) ::close(file);
    return refused("processors may enter deep idle states: /dev/cpu_dma_latency: " + reason +
                   "; run as a user who may write it");
}

std::optional<std::string> terminate_with_parent() {
    if (prctl(PR_SET_PDEATHSIG, static_cast<unsigned long>(SIGTERM), 0UL, 0UL, 0UL) != 0)
        return refused("the parent's death will go unnoticed: " + error_text(errno));
    // The parent may have died before prctl(). Process 1 has then adopted this process.
    if (getppid() != 1) return std::nullopt;
    return std::string("the parent process has already ended");
}

} // namespace tandem::rt
