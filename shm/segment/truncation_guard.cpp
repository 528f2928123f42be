// SPDX-License-Identifier: Apache-2.0
#include "shm/segment/truncation_guard.hpp"

#include "shm/os/error.hpp"
#include "shm/segment/layout.hpp"

#include <array>
#include <atomic>
#include <csignal>
#include <sys/mman.h>

namespace tandem::shm {
namespace {

/// Read by a signal handler: no locks. More segments than that at once go unguarded.
struct Range {
    std::atomic<bool> taken{false};
    std::atomic<std::uintptr_t> begin{0}, end{0};
};
std::array<Range, 256> ranges;
struct sigaction before {};

/// Everything from the lost page to the end of the mapping is behind the end of the file, too.
bool replace_lost(std::uintptr_t address) {
    for (const auto& range : ranges) {
        // The end first: it is stored last, so the begin belongs to it.
        const std::uintptr_t end = range.end.load(std::memory_order_acquire);
        const std::uintptr_t begin = range.begin.load(std::memory_order_acquire);
        if (address < begin || address >= end) continue;
        const std::uintptr_t lost = address - address % layout::page;
        auto* at = reinterpret_cast<void*>(lost); // NOLINT(performance-no-int-to-ptr)
        return mmap(at, end - lost, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0) ==
               at;
    }
    return false;
}

void on_bus_error(int signal, siginfo_t* info, void* context) {
    const int saved = errno;
    if (info->si_code == BUS_ADRERR && replace_lost(reinterpret_cast<std::uintptr_t>(info->si_addr))) {
        errno = saved;
        return; // the access is tried again
    }
    if ((before.sa_flags & SA_SIGINFO) != 0) {
        before.sa_sigaction(signal, info, context);
    } else if (before.sa_handler != SIG_DFL && before.sa_handler != SIG_IGN) {
        before.sa_handler(signal);
    } else {
        ::signal(signal, SIG_DFL); // the access is tried again, and ends the process
    }
}

} // namespace

void install_truncation_guard() {
    // Not again when another handler stands before ours meanwhile: each would go on to the other for ever.
    static const bool once = [] {
        struct sigaction guard {};
        guard.sa_sigaction = on_bus_error;
        guard.sa_flags = SA_SIGINFO | SA_ONSTACK;
        if (sigaction(SIGBUS, nullptr, &before) == 0 && sigaction(SIGBUS, &guard, nullptr) == 0) return true;
        throw Error("SIGBUS: no handler can be installed (" + errno_text() + ")");
    }();
    static_cast<void>(once);
}

GuardedRange::GuardedRange(void* begin, std::size_t bytes) : place_(0) {
    for (; place_ < ranges.size(); ++place_) {
        auto& range = ranges[place_];
        if (range.taken.exchange(true, std::memory_order_acq_rel)) continue;
        const auto address = reinterpret_cast<std::uintptr_t>(begin);
        range.begin.store(address, std::memory_order_release);
        range.end.store(address + bytes, std::memory_order_release);
        return;
    }
}

GuardedRange::~GuardedRange() {
    if (place_ == ranges.size()) return;
    ranges[place_].end.store(0, std::memory_order_release);
    ranges[place_].taken.store(false, std::memory_order_release);
}

} // namespace tandem::shm
