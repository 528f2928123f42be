// SPDX-License-Identifier: Apache-2.0
#include "host/crash/callback_scope.hpp"

#include "host/crash/alternate_stack.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <ctime>
#include <mutex>
#include <vector>

namespace tandem::crash {

/// The scopes of one thread, the outermost first. The thread writes them; any thread may read them.
struct ThreadCallbacks {
    struct Entry {
        std::atomic<const void*> component{nullptr};
        std::atomic<const char*> component_name{nullptr};
        std::atomic<const char*> callback{nullptr};
        std::atomic<const char*> port{nullptr}; ///< set by PortScope, which most scopes do without
        std::atomic<const void*> code{nullptr};
        std::atomic<long> since_ns{0};
    };
    // Deeper scopes are counted but not recorded.
    static constexpr unsigned max_depth = 16;

    std::atomic<unsigned> depth{0};
    std::array<Entry, max_depth> entries;
    CallbackText* text = nullptr; // of this thread's CallbackPublication

    void publish() const;
    unsigned recorded() const { return std::min(depth.load(std::memory_order_acquire), max_depth); }
};

namespace {

constexpr auto relaxed = std::memory_order_relaxed;

struct Registry {
    std::mutex mutex;
    std::vector<const ThreadCallbacks*> threads;
};

// Never deleted: a thread that hangs in a callback may outlive static objects.
Registry& registry() {
    static auto* the_registry = new Registry;
    return *the_registry;
}

struct RegisteredThread : ThreadCallbacks {
    RegisteredThread() {
        const std::lock_guard lock(registry().mutex);
        registry().threads.push_back(this);
    }
    ~RegisteredThread() {
        const std::lock_guard lock(registry().mutex);
        std::erase(registry().threads, this);
    }
};

// In static thread storage, so that finding it takes no function call.
[[gnu::tls_model("initial-exec")]] constinit thread_local ThreadCallbacks* this_thread = nullptr;

ThreadCallbacks& register_this_thread() {
    give_this_thread_an_alternate_stack();
    static thread_local RegisteredThread thread;
    this_thread = &thread;
    return thread;
}

// Returns steady_clock's time at the last timer interrupt. Reading the hardware clock would cost more than the rest
// of a scope.
long coarse_now_ns() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC_COARSE, &now);
    return now.tv_sec * 1'000'000'000 + now.tv_nsec;
}

RunningCallback running_in(const ThreadCallbacks::Entry& entry) {
    using Clock = std::chrono::steady_clock;
    return {entry.component_name.load(relaxed), entry.callback.load(relaxed), entry.port.load(relaxed),
            entry.code.load(relaxed),
            Clock::time_point(std::chrono::nanoseconds(entry.since_ns.load(relaxed)))};
}

// Uses a loop: for short names it is faster than a call of the C library.
template <std::size_t Size>
void copy(char (&to)[Size], const char* from) {
    std::size_t i = 0;
    for (; from != nullptr && i + 1 < Size && from[i] != 0; ++i) to[i] = from[i];
    to[i] = 0;
}

// Finds the component's innermost scope in the thread.
std::optional<RunningCallback> find_in(const ThreadCallbacks& thread, const void* component) {
    for (unsigned i = thread.recorded(); i-- > 0;)
        if (thread.entries[i].component.load(relaxed) == component) return running_in(thread.entries[i]);
    return std::nullopt;
}

} // namespace

// Writes the callback last: a reader ignores a text without a callback. [this thread]
void ThreadCallbacks::publish() const {
    text->callback[0] = 0;
    const unsigned count = recorded();
    if (count == 0) return;
    copy(text->component, entries[count - 1].component_name.load(relaxed));
    copy(text->callback, entries[count - 1].callback.load(relaxed));
}

CallbackPublication::CallbackPublication(CallbackText* text)
    : thread_(this_thread ? *this_thread : register_this_thread()) {
    thread_.text = text;
}

CallbackPublication::~CallbackPublication() { thread_.text = nullptr; }

CallbackScope::CallbackScope(const void* component, const char* component_name, const char* callback,
                             const void* code)
    : thread_(this_thread ? *this_thread : register_this_thread()) {
    const unsigned depth = thread_.depth.load(relaxed);
    if (depth < ThreadCallbacks::max_depth) {
        ThreadCallbacks::Entry& entry = thread_.entries[depth];
        entry.component.store(component, relaxed);
        entry.component_name.store(component_name, relaxed);
        entry.callback.store(callback, relaxed);
        entry.code.store(code, relaxed);
        entry.since_ns.store(coarse_now_ns(), relaxed);
    }
    thread_.depth.store(depth + 1, std::memory_order_release); // a reader sees the complete entry
    if (thread_.text != nullptr) thread_.publish();
}

CallbackScope::~CallbackScope() {
    thread_.depth.store(thread_.depth.load(relaxed) - 1, std::memory_order_release);
    if (thread_.text != nullptr) thread_.publish();
}

PortScope::PortScope(const char* port) : port_(nullptr) {
    const unsigned depth = this_thread->depth.load(relaxed);
    if (depth > ThreadCallbacks::max_depth) return;
    port_ = &this_thread->entries[depth - 1].port;
    port_->store(port, relaxed);
}

PortScope::~PortScope() {
    if (port_ != nullptr) port_->store(nullptr, relaxed);
}

std::optional<RunningCallback> running_callback() {
    const unsigned depth = this_thread ? this_thread->recorded() : 0;
    if (depth == 0) return std::nullopt;
    return running_in(this_thread->entries[depth - 1]);
}

std::optional<RunningCallback> find_running_callback(const void* component) {
    if (component == nullptr) return std::nullopt;
    const std::lock_guard lock(registry().mutex);
    std::optional<RunningCallback> longest;
    for (const ThreadCallbacks* thread : registry().threads)
        if (const auto found = find_in(*thread, component);
            found && (!longest || found->since < longest->since))
            longest = found;
    return longest;
}

} // namespace tandem::crash
