// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/harness/forked_children.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <poll.h>
#include <sys/prctl.h>
#include <system_error>
#include <unistd.h>

namespace tandem::bench {

namespace {
volatile std::sig_atomic_t interrupt_seen = 0;
}

pid_t fork_child() {
    const pid_t parent = getpid();
    std::fflush(nullptr); // otherwise the child would write the buffered text once more
    const pid_t child = fork();
    if (child < 0) throw std::system_error(errno, std::generic_category(), "cannot fork");
    if (child == 0) {
        signal(SIGINT, SIG_DFL);
        signal(SIGTERM, SIG_DFL);
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (getppid() != parent) _exit(1); // the parent died before prctl()
    }
    return child;
}

std::string ForkedChildren::wait(double seconds) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    for (;;) {
        std::vector<pollfd> running;
        for (std::size_t i = 0; i < children_.size(); ++i) {
            const auto& ended = children_[i].poll();
            if (!ended)
                running.push_back({children_[i].pidfd(), POLLIN, 0});
            else if (ended->signalled)
                return fmt::format("side {} was ended by signal {}", "AB"[i], strsignal(ended->code));
            else if (!ended->success())
                return fmt::format("side {} failed", "AB"[i]);
        }
        if (running.empty()) return {};
        const std::chrono::duration<double, std::milli> rest = deadline - std::chrono::steady_clock::now();
        const int changed = poll(running.data(), running.size(), std::max(0, static_cast<int>(rest.count())));
        if (interrupted()) return "interrupted"; // the signal has ended poll() with EINTR
        if (changed == 0) return fmt::format("not finished after {:g} s", seconds);
    }
}

void catch_interrupts() {
    struct sigaction action {};
    action.sa_handler = [](int) { interrupt_seen = 1; };
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() { return interrupt_seen != 0; }

} // namespace tandem::bench
