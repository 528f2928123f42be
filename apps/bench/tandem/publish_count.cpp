// SPDX-License-Identifier: Apache-2.0
// How many system calls and allocations 100,000 publishes take while the reader is awake: each system call is
// caught by a seccomp filter and counted in its signal handler, each operator new by a replaced one.
#include "apps/bench/harness/allocation_count.hpp"
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/tandem/ring_endpoint.hpp"

#include <csignal>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <system_error>

namespace tandem::bench {

namespace {

constexpr int publishes = 100'000;
volatile std::sig_atomic_t system_calls = 0;

/// From here on every system call of this process is refused and counted, but those that end a process or a
/// signal handler. Cannot be undone; what the process does afterwards it does in vain.
void catch_system_calls() {
    struct sigaction action {};
    action.sa_handler = [](int) { system_calls = system_calls + 1; };
    sigaction(SIGSYS, &action, nullptr);
    sock_filter code[] = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_rt_sigreturn, 2, 0),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_exit_group, 1, 0),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
    };
    const sock_fprog program{sizeof code / sizeof *code, code};
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
        prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0)
        throw std::system_error(errno, std::generic_category(), "cannot set a seccomp filter");
}

template <Wake wake>
void count_publishes(Session& session) {
    using Endpoint = RingEndpoint<64, wake>;
    Endpoint endpoint(session, std::chrono::seconds(10)); // the reader spins throughout
    session.arrive_and_wait();
    if (!session.is_a()) {
        while (endpoint.receive() != stop_sequence) {
        }
        return;
    }
    endpoint.send(1);
    const bool calls = session.bench_case().operation == "publish-system-calls";
    const std::uint64_t allocated = allocation_count();
    if (calls) catch_system_calls();
    for (std::uint64_t i = 0; i < publishes; ++i) endpoint.send(2);
    const auto counted = static_cast<double>(system_calls);
    session.add_result(calls ? counted : static_cast<double>(allocation_count() - allocated));
    endpoint.send(stop_sequence);
    if (calls) _exit(0);
}

template <Wake wake>
void add_counts(Registry& registry) {
    for (const char* operation : {"publish-system-calls", "publish-allocations"}) {
        Case entry;
        entry.subject = "ring";
        entry.operation = operation;
        entry.wake = wake;
        entry.unit = Unit::count;
        entry.run = count_publishes<wake>;
        registry.cases.push_back(entry);
    }
}

} // namespace

void add_tandem_publish_count_cases(Registry& registry) {
    add_counts<Wake::spin>(registry);
    add_counts<Wake::spin_then_futex>(registry);
}

} // namespace tandem::bench
