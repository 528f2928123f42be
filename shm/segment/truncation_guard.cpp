// SPDX-License-Identifier: Apache-2.0
#include "shm/segment/truncation_guard.hpp"

#include "shm/os/error.hpp"

#include <array>
#include <atomic>
#include <csignal>
#include <ctime>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace tandem::shm {
namespace {

/// A signal handler reads these ranges, so they have no locks. Segments beyond the size of the array are not guarded.
struct Range {
    std::atomic<bool> taken{false};
    std::atomic<std::uintptr_t> begin{0}, end{0};
    std::atomic<std::uintptr_t> zeros{0}; ///< the range from here to the end is zeros already
    std::atomic<bool> replacing{false};   ///< a thread is changing `zeros`
};
std::array<Range, 256> ranges;
struct sigaction previous_action {};
const auto kernel_page =
    static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE)); // a signal handler must not ask for it

// How long a thread waits for another thread that is replacing pages. That thread may have been stopped by a signal, and
// does not exist in the child of a fork().
constexpr timespec replacing_step{0, 20'000};
constexpr int max_replacing_steps = 5'000;

/// Maps zeros from the lost page to the end of the mapping, because all of that is beyond the end of the file, too. Each page is
/// replaced only once: another thread may have stored into the zeros already, for example that all waits have ended.
bool replace_lost_pages(Range& range, std::uintptr_t lost) {
    for (int i = 0; i < max_replacing_steps && range.replacing.exchange(true, std::memory_order_acquire); ++i)
        nanosleep(&replacing_step, nullptr);
    const std::uintptr_t zeros = range.zeros.load(std::memory_order_relaxed);
    bool replaced = true;
    if (lost < zeros) {
        // Makes the system call directly: POSIX does not allow mmap() in a signal handler, and the thread sanitizer would
        // treat mmap() as a write by this thread, although the kernel exchanges whole pages.
        replaced = syscall(SYS_mmap, lost, zeros - lost, PROT_READ | PROT_WRITE,
                           MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0) == static_cast<long>(lost);
        if (replaced) range.zeros.store(lost, std::memory_order_relaxed);
    }
    range.replacing.store(false, std::memory_order_release);
    return replaced;
}

/// Returns false if the address is in no segment.
bool replace_lost_pages(std::uintptr_t address) {
    for (auto& range : ranges) {
        // Reads the end first: it is stored last, so the begin that is read afterwards belongs to it.
        const std::uintptr_t end = range.end.load(std::memory_order_acquire);
        const std::uintptr_t begin = range.begin.load(std::memory_order_acquire);
        if (address < begin || address >= end) continue;
        return replace_lost_pages(range, address - address % kernel_page);
    }
    return false;
}

void on_bus_error(int signal, siginfo_t* info, void* context) {
    const int saved = errno;
    if (info->si_code == BUS_ADRERR && replace_lost_pages(reinterpret_cast<std::uintptr_t>(info->si_addr))) {
        errno = saved;
        return; // the CPU repeats the access
    }
    if ((previous_action.sa_flags & SA_SIGINFO) != 0) {
        previous_action.sa_sigaction(signal, info, context);
    } else if (previous_action.sa_handler != SIG_DFL && previous_action.sa_handler != SIG_IGN) {
        previous_action.sa_handler(signal);
    } else {
        ::signal(signal, SIG_DFL); // the repeated access ends the process
    }
}

} // namespace

void install_truncation_guard() {
    // Only once, even if another handler was installed after this one: otherwise each of the two would pass the signal
    // on to the other forever.
    static const bool once = [] {
        struct sigaction guard {};
        guard.sa_sigaction = on_bus_error;
        guard.sa_flags = SA_SIGINFO | SA_ONSTACK;
        if (sigaction(SIGBUS, nullptr, &previous_action) == 0 && sigaction(SIGBUS, &guard, nullptr) == 0)
            return true;
        throw Error("SIGBUS: no handler can be installed (" + errno_text() + ")");
    }();
    static_cast<void>(once);
}

TruncationGuardedRange::TruncationGuardedRange(void* begin, std::size_t bytes) : index_(0) {
    for (; index_ < ranges.size(); ++index_) {
        auto& range = ranges[index_];
        if (range.taken.exchange(true, std::memory_order_acq_rel)) continue;
        const auto address = reinterpret_cast<std::uintptr_t>(begin);
        range.begin.store(address, std::memory_order_release);
        range.zeros.store(address + bytes, std::memory_order_release);
        range.replacing.store(false, std::memory_order_release);
        range.end.store(address + bytes, std::memory_order_release);
        return;
    }
}

TruncationGuardedRange::~TruncationGuardedRange() {
    if (index_ == ranges.size()) return;
    ranges[index_].end.store(0, std::memory_order_release);
    ranges[index_].taken.store(false, std::memory_order_release);
}

} // namespace tandem::shm
