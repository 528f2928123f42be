// SPDX-License-Identifier: Apache-2.0
// A thread of the test, on the one OS thread of the checker. makecontext builds the stack, _setjmp and
// _longjmp switch: unlike swapcontext they make no system call, and a search switches millions of times.
#pragma once
#include <csetjmp>
#include <cstddef>
#include <functional>
#include <memory>
#include <pthread.h>
#include <ucontext.h>

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/common_interface_defs.h>
#endif

namespace tandem::shm::model {

/// A place to go on from: the main stack, or a Fiber's.
class Context {
  public:
    /// The stack that the caller came with.
    Context() {
        pthread_attr_t attributes;
        pthread_getattr_np(pthread_self(), &attributes);
        pthread_attr_getstack(&attributes, &stack_, &stack_bytes_);
        pthread_attr_destroy(&attributes);
    }
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// Switches from this context, which is running, to another one. Returns when another context switches back.
    void switch_to(Context& other) {
        running() = &other;
#if defined(__SANITIZE_ADDRESS__)
        void* fake = nullptr;
        __sanitizer_start_switch_fiber(&fake, other.stack_, other.stack_bytes_);
        if (_setjmp(here_) == 0) _longjmp(other.here_, 1);
        __sanitizer_finish_switch_fiber(fake, nullptr, nullptr);
#else
        if (_setjmp(here_) == 0) _longjmp(other.here_, 1);
#endif
    }

  protected:
    Context(void* stack, std::size_t bytes) : stack_(stack), stack_bytes_(bytes) {}

    static Context*& running() {
        static Context* context = nullptr;
        return context;
    }

    jmp_buf here_;
    void* stack_ = nullptr;
    std::size_t stack_bytes_ = 0;
};

/// Calls `work` over and over; `work` hands the processor on with switch_to before it returns.
class Fiber : public Context {
  public:
    explicit Fiber(std::function<void()> work)
        : Context(nullptr, bytes), work_(std::move(work)), memory_(new std::byte[bytes]) {
        stack_ = memory_.get();
        ucontext_t made{};
        getcontext(&made);
        made.uc_stack.ss_sp = stack_;
        made.uc_stack.ss_size = bytes;
        made.uc_link = nullptr;
        running() = this;
        makecontext(&made, &Fiber::entry, 0);
        swapcontext(&maker_, &made); // comes back as soon as here_ is set
    }

  private:
    static constexpr std::size_t bytes = 256 * 1024;

    static void entry() {
        auto* maker = static_cast<Fiber*>(running());
        if (_setjmp(maker->here_) == 0) setcontext(&maker->maker_);
#if defined(__SANITIZE_ADDRESS__)
        __sanitizer_finish_switch_fiber(nullptr, nullptr, nullptr);
#endif
        auto* self = static_cast<Fiber*>(running()); // a local from before _setjmp is not to be trusted
        for (;;) self->work_();
    }

    std::function<void()> work_;
    std::unique_ptr<std::byte[]> memory_;
    ucontext_t maker_{};
};

} // namespace tandem::shm::model
