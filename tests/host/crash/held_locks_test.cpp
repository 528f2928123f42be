// SPDX-License-Identifier: Apache-2.0
// A traced process stops before each signal takes effect. Before the last one, it still exists and has not yet begun to
// write a core dump.
#include "host/crash/crash_report.hpp"

#include <catch2/catch.hpp>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fcntl.h>
#include <string>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

constexpr int not_permitted = 77;

int call_for_lock(int file, int command, struct flock& lock) {
    lock = {};
    lock.l_type = F_WRLCK;
    lock.l_whence = SEEK_SET;
    lock.l_len = 1;
    return fcntl(file, command, &lock);
}

bool is_locked(int file) {
    struct flock lock;
    return call_for_lock(file, F_OFD_GETLK, lock) == 0 && lock.l_type != F_UNLCK;
}

/// Locks the file through a second open file, and receives the signal (0: std::terminate()).
[[noreturn]] void end_with_lock(int file, int number) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) _exit(not_permitted);
    const int again = open(("/proc/self/fd/" + std::to_string(file)).c_str(), O_RDWR | O_CLOEXEC);
    const int null = open("/dev/null", O_WRONLY | O_CLOEXEC);
    struct flock lock;
    if (again < 0 || null < 0 || call_for_lock(again, F_OFD_SETLK, lock) != 0) _exit(1);
    dup2(null, STDERR_FILENO);    // for the report
    std::signal(number, SIG_DFL); // Catch handles some of them
    tandem::crash::install_crash_report("test");
    raise(SIGSTOP);
    if (number == 0) std::terminate();
    raise(number);
    _exit(2);
}

/// Returns the signal before which the traced process has stopped; 0 if it has ended.
int wait_for_stop(pid_t process, int& status) {
    REQUIRE(waitpid(process, &status, 0) == process);
    return WIFSTOPPED(status) ? WSTOPSIG(status) : 0;
}

} // namespace

TEST_CASE("a process that crashes gives up its locks before the signal ends it") {
    const int number = GENERATE(SIGSEGV, SIGABRT, SIGQUIT, SIGXCPU, 0);
    CAPTURE(number);
    std::FILE* const stream = std::tmpfile();
    REQUIRE(stream != nullptr);
    const int file = fileno(stream);
    const pid_t process = fork();
    if (process == 0) end_with_lock(file, number);
    int status = 0;
    const int first = wait_for_stop(process, status);
    if (WIFEXITED(status) && WEXITSTATUS(status) == not_permitted) return;
    REQUIRE(first == SIGSTOP);
    CHECK(is_locked(file));
    ptrace(PTRACE_CONT, process, nullptr, nullptr);
    if (number != 0) { // the first signal, which the handler will catch
        REQUIRE(wait_for_stop(process, status) == number);
        ptrace(PTRACE_CONT, process, nullptr, number);
    }
    const int last = number == 0 ? SIGABRT : number;
    CHECK(wait_for_stop(process, status) == last);
    CHECK_FALSE(is_locked(file));
    ptrace(PTRACE_CONT, process, nullptr, last);
    CHECK(wait_for_stop(process, status) == 0);
    CHECK((WIFSIGNALED(status) && WTERMSIG(status) == last));
    std::fclose(stream);
}
