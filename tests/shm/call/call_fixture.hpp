// SPDX-License-Identifier: Apache-2.0
// Two ends of a call queue in one process, and workers for it.
#pragma once
#include "tests/shm/fixture.hpp"

#include "shm/call/call_client.hpp"
#include "shm/call/call_server.hpp"

#include <future>

namespace tandem::shm::test {

/// first calls, second serves.
struct CallPair : Pair {
    explicit CallPair(const CallQueueOptions& options = {.slots = 8, .max_bytes = 4096},
                      const WaitOptions& how = {})
        : client(first->add_call_queue("c", options), how),
          server((first->publish(), seen_by_second()), how) {}
    /// Through first's addresses: the thread sanitizer knows words by address, and would see no
    /// connection between the two mappings that the sides have in one process.
    CallQueueHandle seen_by_second() {
        auto handle = *second->find_call_queue(Side::first, "c");
        const auto same = *first->find_call_queue(Side::first, "c");
        handle.view = same.view;
        handle.times = same.times;
        return handle;
    }
    CallClient client;
    CallServer server;
};

/// Workers that run a function for every call until the server ends their waits.
struct Workers {
    Workers(CallServer& server, int count, std::function<void(IncomingCall&)> work) : server_(server) {
        for (int i = 0; i < count; ++i)
            threads_.emplace_back([&server, work] {
                for (;;) {
                    auto call = server.take(10s);
                    if (!call) return;
                    work(*call);
                }
            });
    }
    ~Workers() {
        server_.end_all_waits();
        for (auto& thread : threads_) thread.join();
    }
    CallServer& server_;
    std::vector<std::thread> threads_;
};

/// A call from a separate thread; Catch's assertions are for one thread only.
inline std::future<CallStatus> call_aside(CallClient& client, std::chrono::nanoseconds timeout) {
    return std::async(std::launch::async, [&client, timeout] { return client.call({}, timeout).status; });
}

inline void echo(IncomingCall& call) { call.reply(CallStatus::ok, call.arguments()); }

/// Returns the number that a call has as its arguments, in decimal; 0 if it has none.
inline std::size_t number_of(const IncomingCall& call) {
    const std::string text = text_of(call.arguments());
    return text.empty() ? 0 : std::stoul(text);
}

} // namespace tandem::shm::test
