// SPDX-License-Identifier: Apache-2.0
// Our call queue: one client, one server, 64 bytes there and 64 back.
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/tandem/bench_link.hpp"

#include "shm/call/call_client.hpp"
#include "shm/call/call_server.hpp"
#include <fmt/format.h>

namespace tandem::bench {

namespace {

constexpr std::size_t bytes = 64;
constexpr const char* queue_name = "calls";
constexpr std::chrono::seconds call_bound{10};

shm::CallQueueHandle open_queue(BenchLink& link, bool callers) {
    if (callers) {
        shm::CallQueueOptions options;
        options.callers = link.mine();
        options.max_bytes = 4096;
        const auto queue = link.segment().add_call_queue(queue_name, options);
        link.open();
        return queue;
    }
    link.open();
    const auto found = link.segment().find_call_queue(shm::other(link.mine()), queue_name);
    if (!found) throw std::runtime_error("the other side has no call queue");
    return *found;
}

class BenchCallClient {
  public:
    explicit BenchCallClient(Session& session)
        : link_(session, arena_bytes),
          client_(open_queue(link_, true),
                  wait_options(session.bench_case().wake, session.bench_case().regime)) {}

    std::uint64_t call(std::uint64_t sequence) {
        fill_message(message_, bytes, sequence);
        const auto status = client_.call_into(1, std::as_bytes(std::span(message_)), call_bound, reply_);
        if (status != shm::CallStatus::ok || reply_.size() != bytes)
            throw std::runtime_error(fmt::format("call {}: {}", sequence, shm::name_of(status)));
        return checked_sequence(reply_.data(), bytes);
    }
    static constexpr std::size_t arena_bytes = std::size_t{1} << 20U;

  private:
    std::uint64_t message_[bytes / sizeof(std::uint64_t)] = {};
    std::vector<std::byte> reply_;
    BenchLink link_;
    shm::CallClient client_;
};

class BenchCallServer {
  public:
    explicit BenchCallServer(Session& session)
        : link_(session, BenchCallClient::arena_bytes),
          server_(open_queue(link_, false),
                  wait_options(session.bench_case().wake, session.bench_case().regime)) {}

    std::uint64_t serve() {
        for (;;) {
            auto call = server_.take(std::chrono::seconds(1));
            if (!call) continue;
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

void add_tandem_call_cases(Registry& registry) {
    for (Wake wake : {Wake::spin, Wake::spin_then_futex, Wake::blocking}) {
        Case entry;
        entry.subject = "call-queue";
        entry.operation = "call";
        entry.wake = wake;
        entry.run = measure_calls<BenchCallClient, BenchCallServer>;
        registry.add_regimes(entry);
        if (wake != Wake::spin) continue;
        entry.placement = Placement::threads;
        registry.cases.push_back(entry);
    }
}

} // namespace tandem::bench
