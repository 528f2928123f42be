// SPDX-License-Identifier: Apache-2.0
// A process that is killed between two of its system calls. Code that works by system calls, like joining and
// leaving a segment, changes what others see there and nowhere else (but for the few words it stores
// between two of them), so these are its points. It costs the code under test nothing: the kernel stops it.
#pragma once
#include "../shm/fixture.hpp"

#include <csignal>
#include <sys/ptrace.h>

namespace tandem::shm::test {

/// Runs `work` in a child after `before`, and kills it at its k-th stop from there: before a system call is
/// entered, or when it is done.
class Stepped {
  public:
    /// Returns whether this process may trace its children, which a container may forbid.
    static bool possible() {
        Child probe([] { return ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) == 0 ? 0 : 1; });
        return probe.wait() == 0;
    }

    Stepped(unsigned k, const std::function<void()>& before, const std::function<void()>& work) {
        pid_ = fork();
        if (pid_ == 0) {
            try {
                before();
                ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
                raise(SIGSTOP);
                work();
                _exit(0);
            } catch (const std::exception& failure) {
                fprintf(stderr, "child: %s\n", failure.what());
                _exit(99);
            }
        }
        step(k);
    }

    bool died() const { return WIFSIGNALED(status_); }
    /// Returns 0 if it was killed or has ended.
    int result() const { return WIFEXITED(status_) ? WEXITSTATUS(status_) : 0; }
    std::string point() const {
        return std::string(entered_ ? "before" : "after") + " system call " + std::to_string(last_call_);
    }

  private:
    void step(unsigned k) {
        waitpid(pid_, &status_, 0); // its SIGSTOP
        ptrace(PTRACE_SETOPTIONS, pid_, nullptr,
               PTRACE_O_TRACESYSGOOD); // without it, stops have no information
        for (unsigned stop = 0; WIFSTOPPED(status_); ++stop) {
            if (stop != 0) {
                __ptrace_syscall_info call{};
                ptrace(PTRACE_GET_SYSCALL_INFO, pid_, sizeof call, &call);
                entered_ = call.op == PTRACE_SYSCALL_INFO_ENTRY;
                if (entered_) last_call_ = call.entry.nr;
            }
            if (stop == k) kill(pid_, SIGKILL);
            ptrace(PTRACE_SYSCALL, pid_, nullptr, nullptr);
            waitpid(pid_, &status_, 0);
        }
    }

    pid_t pid_ = 0;
    int status_ = 0;
    std::uint64_t last_call_ = 0;
    bool entered_ = false;
};

} // namespace tandem::shm::test
