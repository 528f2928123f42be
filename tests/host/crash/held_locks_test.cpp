// SPDX-License-Identifier: Apache-2.0
// A traced process stops before each signal takes effect. Before the last one, it still exists and has not yet begun to
// write a core dump.
#include "host/crash/crash_report.hpp"
#include "tests/support/skip.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fcntl.h>
#include <fstream>
#include <functional>
#include <string>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace {

constexpr int skipped = 77, keeps_main_thread = 78;

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

/// Locks the file through a second open file.
void lock_again(int file) {
    const int again = open(("/proc/thread-self/fd/" + std::to_string(file)).c_str(), O_RDWR | O_CLOEXEC);
    struct flock lock;
    if (again < 0 || call_for_lock(again, F_OFD_SETLK, lock) != 0) _exit(1);
}

/// Locks the file, and receives the signal (0: std::terminate()).
[[noreturn]] void end_with_lock(int file, int number) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) _exit(skipped);
    lock_again(file);
    const int null = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (null < 0) _exit(1);
    dup2(null, STDERR_FILENO);    // for the report
    std::signal(number, SIG_DFL); // Catch handles some of them
    tandem::crash::install_crash_report("test");
    raise(SIGSTOP);
    if (number == 0) std::terminate();
    raise(number);
    _exit(2);
}

/// Returns the state of a process in /proc, for example 'S' while it sleeps and 'Z' after the end of its main thread.
char state_of(pid_t process) {
    std::ifstream file("/proc/" + std::to_string(process) + "/stat");
    std::string text;
    std::getline(file, text);
    const auto name_end = text.rfind(") ");
    return name_end == std::string::npos ? '?' : text[name_end + 2];
}

bool eventually(const std::function<bool()>& holds) {
    for (int i = 0; i < 8000 && !holds(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return holds();
}

/// Ends the main thread, and then the process by a signal in another thread.
[[noreturn]] void end_without_main_thread(int file) {
    std::thread([file] {
        if (!eventually([] { return state_of(getpid()) == 'Z'; })) _exit(keeps_main_thread); // as qemu does
        end_with_lock(file, SIGSEGV);
    }).detach();
    for (;;) syscall(SYS_exit, 0); // pthread_exit() would unwind through the test's frames
}

/// Makes standard error a pipe that is full and that nobody reads.
void fill_standard_error() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0 || fcntl(ends[1], F_SETFL, O_NONBLOCK) != 0) _exit(1);
    const std::string text(1024, 'x');
    while (write(ends[1], text.data(), text.size()) > 0) {
    }
    while (write(ends[1], "x", 1) > 0) {
    }
    if (fcntl(ends[1], F_SETFL, 0) != 0 || dup2(ends[1], STDERR_FILENO) < 0) _exit(1);
}

/// Locks the file, and crashes while nobody reads the report. Sleeps only to write the report.
[[noreturn]] void crash_with_full_pipe(int file) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    fill_standard_error();
    std::signal(SIGSEGV, SIG_DFL); // Catch handles it
    tandem::crash::install_crash_report("test");
    lock_again(file);
    raise(SIGSEGV);
    _exit(2);
}

/// Returns the signal before which the traced process or thread has stopped; 0 if it has ended.
int wait_for_stop(pid_t process, int& status) {
    REQUIRE(waitpid(process, &status, __WALL) > 0);
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
    if (WIFEXITED(status) && WEXITSTATUS(status) == skipped) {
        std::fclose(stream);
        TANDEM_SKIP("this process may not trace its children");
    }
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

TEST_CASE("a process whose main thread has ended gives up its locks before the signal ends it, too") {
    std::FILE* const stream = std::tmpfile();
    REQUIRE(stream != nullptr);
    const int file = fileno(stream);
    const pid_t process = fork();
    if (process == 0) end_without_main_thread(file);
    int status = 0;
    const pid_t thread = waitpid(-1, &status, __WALL);
    REQUIRE(thread > 0);
    if (WIFEXITED(status) && (WEXITSTATUS(status) == skipped || WEXITSTATUS(status) == keeps_main_thread)) {
        std::fclose(stream);
        TANDEM_SKIP(WEXITSTATUS(status) == skipped ? "this process may not trace its children"
                                                   : "the main thread does not end before its process");
    }
    REQUIRE((WIFSTOPPED(status) && WSTOPSIG(status) == SIGSTOP));
    CHECK(is_locked(file));
    ptrace(PTRACE_CONT, thread, nullptr, nullptr);
    for (const int wait : {1, 2}) { // before the handler, and before the end
        CAPTURE(wait);
        REQUIRE(wait_for_stop(thread, status) == SIGSEGV);
        CHECK(is_locked(file) == (wait == 1));
        ptrace(PTRACE_CONT, thread, nullptr, SIGSEGV);
    }
    while (waitpid(-1, &status, __WALL) > 0) { // the thread, and the process
    }
    std::fclose(stream);
}

TEST_CASE("a process that crashes keeps its locks while its other threads run and its report is not read") {
    std::FILE* const stream = std::tmpfile();
    REQUIRE(stream != nullptr);
    const int file = fileno(stream);
    bool waits_with_lock = false;
    for (int i = 0; i < 5 && !waits_with_lock;
         ++i) { // the report waits for one second, which a busy machine may miss
        const pid_t process = fork();
        if (process == 0) crash_with_full_pipe(file);
        char state = '?';
        eventually([&] {
            state = state_of(process);
            waits_with_lock = state == 'S' && is_locked(file);
            return waits_with_lock || state == 'Z';
        });
        kill(process, SIGKILL);
        waitpid(process, nullptr, 0);
    }
    CHECK(waits_with_lock);
    std::fclose(stream);
}
