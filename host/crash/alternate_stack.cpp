// SPDX-License-Identifier: Apache-2.0
#include "host/crash/alternate_stack.hpp"

#include <atomic>
#include <csignal>
#include <cstddef>
#include <sys/mman.h>

namespace tandem::crash {
namespace {

std::atomic<bool> enabled{false};

/// For the unwinder and the demangler. The report itself is in static memory.
constexpr std::size_t stack_bytes = std::size_t{128} << 10;

/// The alternate stack of one thread, freed when the thread ends.
class AlternateStack {
  public:
    AlternateStack() {
        stack_t present{};
        if (sigaltstack(nullptr, &present) != 0 || (present.ss_flags & SS_DISABLE) == 0) return;
        void* memory = mmap(nullptr, stack_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (memory == MAP_FAILED) return; // without it, only a stack overflow of this thread is not reported
        stack_t stack{};
        stack.ss_sp = memory;
        stack.ss_size = stack_bytes;
        if (sigaltstack(&stack, nullptr) == 0)
            memory_ = memory;
        else
            munmap(memory, stack_bytes);
    }
    ~AlternateStack() {
        if (memory_ == nullptr) return;
        stack_t none{};
        none.ss_flags = SS_DISABLE;
        sigaltstack(&none, nullptr);
        munmap(memory_, stack_bytes);
    }
    AlternateStack(const AlternateStack&) = delete;
    AlternateStack& operator=(const AlternateStack&) = delete;

  private:
    void* memory_ = nullptr;
};

} // namespace

void enable_alternate_stacks() { enabled = true; }

void give_this_thread_an_alternate_stack() {
    if (!enabled.load(std::memory_order_relaxed)) return;
    static thread_local const AlternateStack stack;
}

} // namespace tandem::crash
