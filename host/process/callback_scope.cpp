// SPDX-License-Identifier: Apache-2.0
#include "host/process/callback_scope.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <vector>

namespace tandem::process {
namespace {

using Clock = std::chrono::steady_clock;

// Deeper scopes are counted and not recorded.
constexpr unsigned max_depth = 16;

struct Entry {
    std::atomic<const void*> component{nullptr};
    std::atomic<const char*> callback{nullptr};
    std::atomic<Clock::rep> since{0};
};

/// The scopes of one thread, the outermost first. Written by that thread, read by any.
struct Stack {
    std::atomic<unsigned> depth{0};
    std::array<Entry, max_depth> entries;
};

struct Registry {
    std::mutex mutex;
    std::vector<Stack*> stacks;
};

// Never deleted: a thread that hangs in a callback may outlive static objects.
Registry& registry() {
    static auto* the_registry = new Registry;
    return *the_registry;
}

struct RegisteredStack : Stack {
    RegisteredStack() {
        const std::lock_guard lock(registry().mutex);
        registry().stacks.push_back(this);
    }
    ~RegisteredStack() {
        const std::lock_guard lock(registry().mutex);
        std::erase(registry().stacks, this);
    }
};

Stack& this_thread() {
    thread_local RegisteredStack stack;
    return stack;
}

// The innermost scope of the component in this thread.
std::optional<RunningCallback> find_in(const Stack& stack, const void* component) {
    for (unsigned i = std::min(stack.depth.load(std::memory_order_acquire), max_depth); i-- > 0;) {
        const Entry& entry = stack.entries[i];
        if (entry.component.load(std::memory_order_relaxed) != component) continue;
        return RunningCallback{
            entry.callback.load(std::memory_order_relaxed),
            Clock::time_point(Clock::duration(entry.since.load(std::memory_order_relaxed)))};
    }
    return std::nullopt;
}

} // namespace

CallbackScope::CallbackScope(const void* component, const char* callback) {
    Stack& stack = this_thread();
    const unsigned depth = stack.depth.load(std::memory_order_relaxed);
    if (depth < max_depth) {
        Entry& entry = stack.entries[depth];
        entry.component.store(component, std::memory_order_relaxed);
        entry.callback.store(callback, std::memory_order_relaxed);
        entry.since.store(Clock::now().time_since_epoch().count(), std::memory_order_relaxed);
    }
    stack.depth.store(depth + 1, std::memory_order_release); // the reader sees the entry complete
}

CallbackScope::~CallbackScope() { this_thread().depth.fetch_sub(1, std::memory_order_release); }

std::optional<RunningCallback> find_running_callback(const void* component) {
    const std::lock_guard lock(registry().mutex);
    std::optional<RunningCallback> longest;
    for (const Stack* stack : registry().stacks)
        if (const auto found = find_in(*stack, component);
            found && (!longest || found->since < longest->since))
            longest = found;
    return longest;
}

} // namespace tandem::process
