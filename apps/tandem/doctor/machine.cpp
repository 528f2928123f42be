// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/doctor/machine.hpp"

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <sched.h>
#include <sys/inotify.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/statvfs.h>
#include <sys/timex.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tandem::doctor {
namespace {

std::uint64_t soft_limit(__rlimit_resource_t resource) {
    rlimit limit{};
    if (getrlimit(resource, &limit) != 0) return 0;
    return limit.rlim_cur == RLIM_INFINITY ? unlimited : limit.rlim_cur;
}

// Runs `attempt` in a child process and returns its errno, 0 if it succeeds. A child process, because the
// caller must not keep locked memory or a real-time priority.
template <class Attempt>
int errno_of_attempt(Attempt attempt) {
    const pid_t child = fork();
    if (child < 0) return errno;
    if (child == 0) _exit(attempt() ? 0 : errno);
    int status = 0;
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR) return errno;
    // The kernel kills the child only if there is not enough memory to lock.
    return WIFEXITED(status) ? WEXITSTATUS(status) : ENOMEM;
}

// mlockall() can succeed under a limit that the next allocation exceeds. With MCL_FUTURE that allocation
// fails, so an allocation is tried too.
bool lock_memory() {
    constexpr std::size_t bytes = std::size_t{64} << 20;
    return mlockall(MCL_CURRENT | MCL_FUTURE) == 0 &&
           mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) != MAP_FAILED;
}

// 50 is the middle of the priority range, where profiles put their components.
bool set_sched_fifo() {
    sched_param parameters{};
    parameters.sched_priority = 50;
    return sched_setscheduler(0, SCHED_FIFO, &parameters) == 0;
}

bool create_inotify_instance() { return inotify_init1(IN_CLOEXEC) >= 0; }

// cpu_set_t holds at most 1024 cores (otherwise EINVAL). In that case all cores count.
unsigned count_usable_cores() {
    cpu_set_t set;
    CPU_ZERO(&set);
    if (sched_getaffinity(0, sizeof set, &set) == 0) return static_cast<unsigned>(CPU_COUNT(&set));
    return static_cast<unsigned>(std::max(1L, sysconf(_SC_NPROCESSORS_ONLN)));
}

} // namespace

bool Machine::exists(const std::string& absolute) const {
    std::error_code ignored; // without permission, the file counts as absent
    return std::filesystem::exists(path(absolute), ignored);
}

// Files of /proc report a size of 0, so they are read to their end.
std::optional<std::string> Machine::content(const std::string& absolute) const {
    std::ifstream file(path(absolute), std::ios::binary);
    if (!file) return std::nullopt;
    std::string text(std::size_t{1} << 20, '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (file.bad()) return std::nullopt;
    text.resize(static_cast<std::size_t>(file.gcount()));
    return text;
}

std::optional<std::string> Machine::first_line(const std::string& absolute) const {
    const auto text = content(absolute);
    if (!text) return std::nullopt;
    return trim(text->substr(0, text->find('\n')));
}

Machine probe_this_machine() {
    Machine machine;
    ProbedValues& probed = machine.probed;
    probed.memlock_limit = soft_limit(RLIMIT_MEMLOCK);
    probed.rtprio_limit = soft_limit(RLIMIT_RTPRIO);
    probed.files_limit = soft_limit(RLIMIT_NOFILE);
    struct statvfs disk {};
    if (statvfs("/dev/shm", &disk) == 0) {
        probed.shm_bytes = disk.f_blocks * disk.f_frsize;
        probed.shm_free = disk.f_bavail * disk.f_frsize;
    }
    probed.lock_error = errno_of_attempt(lock_memory);
    probed.fifo_error = errno_of_attempt(set_sched_fifo);
    probed.inotify_error = errno_of_attempt(create_inotify_instance);
    // Only access(): opening the device for writing would already change the latency.
    probed.dma_latency_error = faccessat(AT_FDCWD, "/dev/cpu_dma_latency", W_OK, AT_EACCESS) == 0 ? 0 : errno;
    probed.timer_slack_ns =
        static_cast<std::uint64_t>(std::max(0, prctl(PR_GET_TIMERSLACK, 0UL, 0UL, 0UL, 0UL)));
    probed.cores = count_usable_cores();
    probed.user = geteuid();
    const char* const runtime_dir = std::getenv("XDG_RUNTIME_DIR");
    probed.runtime_dir = runtime_dir != nullptr ? runtime_dir : "";
    timex clock{}; // modes 0 only reads
    const int state = adjtimex(&clock);
    probed.clock_synchronized = state >= 0 && state != TIME_ERROR && (clock.status & STA_UNSYNC) == 0;
    probed.clock_max_error_us = clock.maxerror;
    return machine;
}

std::string trim(const std::string& text) {
    constexpr auto blanks = " \t\r\n";
    const auto begin = text.find_first_not_of(blanks);
    if (begin == std::string::npos) return "";
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::string bracketed_word(const std::string& choices) {
    const auto begin = choices.find_first_of("[("), end = choices.find_first_of("])");
    if (begin == std::string::npos || end == std::string::npos || end < begin) return "";
    return choices.substr(begin + 1, end - begin - 1);
}

} // namespace tandem::doctor
