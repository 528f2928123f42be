// SPDX-License-Identifier: Apache-2.0
// Counts the system calls and allocations of 100,000 publishes while the reader is awake. A seccomp filter
// turns each system call into a signal, whose handler counts it. operator new is replaced by one that counts.
#include "apps/bench/harness/allocation_count.hpp"
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/registry.hpp"
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

/// From here on, every system call of this thread fails and is counted, except those that end the process or
/// a signal handler. This cannot be undone: the process can only poll shared memory and end.
void count_system_calls() {
    struct sigaction action {};
    action.sa_handler = [](int) { system_calls = system_calls + 1; };
    sigaction(SIGSYS, &action, nullptr);
    // A classic BPF program: load the number of the system call, allow the two, trap all others.
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

/// A publishes; B polls for as long as it takes. Each publish must find the reader awake.
template <Wake wake>
void count_publishes(Session& session) {
    using Endpoint = RingEndpoint<64, wake>;
    Endpoint endpoint(session, std::chrono::seconds(10)); // for polling: the reader never sleeps
    session.arrive_and_wait();
    if (!session.is_side_a()) {
        while (endpoint.receive() != stop_sequence) {
        }
        return;
    }
    endpoint.send(1); // page faults and lazy binding happen here
    const bool counts_calls = session.bench_case().operation == "publish-system-calls";
    const std::uint64_t allocated = allocation_count();
    if (counts_calls) count_system_calls();
    for (std::uint64_t i = 0; i < publishes; ++i) endpoint.send(2);
    const auto counted = static_cast<double>(system_calls);
    session.add_result(counts_calls ? counted : static_cast<double>(allocation_count() - allocated));
    endpoint.send(stop_sequence);
    if (counts_calls) _exit(0); // destructors need system calls
}

template <Wake wake>
void add_counts(Registry& registry) {
    for (const char* operation : {"publish-system-calls", "publish-allocations"}) {
        registry.add({.subject = "ring",
                      .operation = operation,
                      .wake = wake,
                      .unit = Unit::count,
                      .run = count_publishes<wake>});
    }
}

} // namespace

void add_publish_count_cases(Registry& registry) {
    add_counts<Wake::spin>(registry);
    add_counts<Wake::spin_then_futex>(registry);
}

} // namespace tandem::bench
