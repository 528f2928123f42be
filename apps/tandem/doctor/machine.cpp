// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/doctor/machine.hpp"

#include <cerrno>
#include <fcntl.h>
#include <fstream>
#include <sched.h>
#include <sys/inotify.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/statvfs.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tandem::doctor {
namespace {

std::uint64_t soft_limit(__rlimit_resource_t resource) {
    rlimit limit{};
    if (getrlimit(resource, &limit) != 0) return 0;
    return limit.rlim_cur == RLIM_INFINITY ? unlimited : limit.rlim_cur;
}

/// The errno that an attempt in a child process ends with.
template <class Attempt>
int tried(Attempt attempt) {
    const pid_t child = fork();
    if (child < 0) return errno;
    if (child == 0) _exit(attempt() ? 0 : errno);
    int status = 0;
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR) return errno;
    return WIFEXITED(status) ? WEXITSTATUS(status) : ENOMEM; // killed: there was not that much memory
}

bool lock_memory() {
    constexpr std::size_t more = std::size_t{64} << 20;
    return mlockall(MCL_CURRENT | MCL_FUTURE) == 0 &&
           mmap(nullptr, more, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) != MAP_FAILED;
}

bool become_real_time() {
    sched_param parameters{};
    parameters.sched_priority = 50;
    return sched_setscheduler(0, SCHED_FIFO, &parameters) == 0;
}

bool watch_files() { return inotify_init1(IN_CLOEXEC) >= 0; }

unsigned usable_cores() {
    cpu_set_t set;
    CPU_ZERO(&set);
    if (sched_getaffinity(0, sizeof set, &set) == 0) return static_cast<unsigned>(CPU_COUNT(&set));
    return static_cast<unsigned>(std::max(1L, sysconf(_SC_NPROCESSORS_ONLN)));
}

} // namespace

bool Machine::exists(const std::string& absolute) const {
    std::error_code unknown;
    return std::filesystem::exists(path(absolute), unknown);
}

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
    return trimmed(text->substr(0, text->find('\n')));
}

Machine this_machine() {
    Machine machine;
    Answers& answers = machine.answers;
    answers.locked_limit = soft_limit(RLIMIT_MEMLOCK);
    answers.realtime_limit = soft_limit(RLIMIT_RTPRIO);
    answers.files_limit = soft_limit(RLIMIT_NOFILE);
    struct statvfs disk {};
    if (statvfs("/dev/shm", &disk) == 0) {
        answers.shm_bytes = disk.f_blocks * disk.f_frsize;
        answers.shm_free = disk.f_bavail * disk.f_frsize;
    }
    answers.lock_error = tried(lock_memory);
    answers.fifo_error = tried(become_real_time);
    answers.inotify_error = tried(watch_files);
    answers.dma_latency_error =
        faccessat(AT_FDCWD, "/dev/cpu_dma_latency", W_OK, AT_EACCESS) == 0 ? 0 : errno;
    answers.timer_slack_ns =
        static_cast<std::uint64_t>(std::max(0, prctl(PR_GET_TIMERSLACK, 0UL, 0UL, 0UL, 0UL)));
    answers.cores = usable_cores();
    answers.user = geteuid();
    return machine;
}

std::string trimmed(const std::string& text) {
    constexpr auto blanks = " \t\r\n";
    const auto begin = text.find_first_not_of(blanks);
    if (begin == std::string::npos) return "";
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::string bracketed(const std::string& choices) {
    const auto begin = choices.find_first_of("[("), end = choices.find_first_of("])");
    if (begin == std::string::npos || end == std::string::npos || end < begin) return "";
    return choices.substr(begin + 1, end - begin - 1);
}

} // namespace tandem::doctor
