// SPDX-License-Identifier: Apache-2.0
// Tandem's call queue, which carries service calls across a link: one client, one server, a request of 64 bytes
// and a reply of 64.
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/registry.hpp"
#include "apps/bench/tandem/bench_link.hpp"

#include "shm/call/call_client.hpp"
#include "shm/call/call_server.hpp"
#include <fmt/format.h>

namespace tandem::bench {

namespace {

constexpr std::size_t bytes = 64, max_bytes = 4096, arena_bytes = std::size_t{1} << 20U;
constexpr const char* queue_name = "calls";
constexpr std::chrono::seconds call_timeout{10};

/// The client's side owns the queue; the server finds it.
shm::CallQueueHandle open_queue(BenchLink& link, bool is_client) {
    if (is_client) {
        shm::CallQueueOptions options;
        options.callers = link.side();
        options.max_bytes = max_bytes;
        auto queue = link.segment().add_call_queue(queue_name, options);
        link.publish_and_wait();
        return queue;
    }
    link.publish_and_wait();
    const auto found = link.segment().find_call_queue(shm::other(link.side()), queue_name);
    if (!found) throw std::runtime_error("the other side has no call queue");
    return *found;
}

/// The Client of measurements.hpp.
class BenchCallClient {
  public:
    explicit BenchCallClient(Session& session)
        : link_(session, arena_bytes), client_(open_queue(link_, true), wait_options(session.bench_case())) {}

    // The reply must hold the number of the request: a late reply to another call would be noticed.
    std::uint64_t call(std::uint64_t sequence) {
        fill_message(message_, bytes, sequence);
        const auto status = client_.call_into(std::as_bytes(std::span(message_)), call_timeout, reply_);
        if (status != shm::CallStatus::ok || reply_.size() != bytes)
            throw std::runtime_error(fmt::format("call {}: {}", sequence, shm::name_of(status)));
        return checked_sequence(reply_.data(), bytes);
    }

  private:
    std::uint64_t message_[bytes / sizeof(std::uint64_t)] = {};
    std::vector<std::byte> reply_; // keeps its capacity: no allocation per call
    BenchLink link_;
    shm::CallClient client_;
};

/// The Server of measurements.hpp: takes one call at a time, as one worker of the proxy does.
class BenchCallServer {
  public:
    explicit BenchCallServer(Session& session)
        : link_(session, arena_bytes), server_(open_queue(link_, false), wait_options(session.bench_case())) {
    }

    std::uint64_t serve() {
        for (;;) {
            auto call = server_.take(std::chrono::seconds(1));
            if (!call) continue; // the client is not ready yet
            const std::uint64_t sequence = checked_sequence(call->arguments().data(), bytes);
            fill_message(message_, bytes, sequence);
            call->reply(shm::CallStatus::ok, std::as_bytes(std::span(message_)));
            return sequence;
        }
    }

  private:
    std::uint64_t message_[bytes / sizeof(std::uint64_t)] = {};
    BenchLink link_;
    shm::CallServer server_;
};

} // namespace

void add_call_cases(Registry& registry) {
    for (Wake wake : {Wake::spin, Wake::spin_then_futex, Wake::blocking}) {
        Case call{.subject = "call-queue",
                  .operation = "call",
                  .bytes = bytes,
                  .wake = wake,
                  .run = measure_calls<BenchCallClient, BenchCallServer>};
        registry.add_with_conditions(call);
        if (wake != Wake::spin) continue;
        call.placement = Placement::threads; // what the process boundary itself costs
        registry.add(call);
    }
}

} // namespace tandem::bench
