// SPDX-License-Identifier: Apache-2.0
// Tandem's call queue, which carries service calls across a link: one client, one server, a request of 64
// bytes and a reply of 64.
#include "apps/bench/baseline/index_ring_endpoint.hpp"
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/registry.hpp"
#include "apps/bench/measurements/paired.hpp"
#include "apps/bench/tandem/bench_link.hpp"

#include "shm/call/call_client.hpp"
#include "shm/call/call_server.hpp"
#include <fmt/format.h>

#include <optional>

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

    // The reply must contain the number of the request, so that a late reply to another call is noticed.
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
        const std::uint64_t sequence = take();
        reply(sequence);
        return sequence;
    }
    std::uint64_t take() {
        while (!call_) // the client may not be ready yet
            if (auto call = server_.take(std::chrono::seconds(1))) call_.emplace(std::move(*call));
        return checked_sequence(call_->arguments().data(), bytes);
    }
    void reply(std::uint64_t sequence) {
        fill_message(message_, bytes, sequence);
        call_->reply(shm::CallStatus::ok, std::as_bytes(std::span(message_)));
        call_.reset();
    }

  private:
    std::uint64_t message_[bytes / sizeof(std::uint64_t)] = {};
    BenchLink link_;
    shm::CallServer server_;
    std::optional<shm::IncomingCall> call_; // ends before its server
};

/// Calls as an Endpoint of paired.hpp.
class CallEndpoint {
  public:
    explicit CallEndpoint(Session& session) {
        if (session.is_side_a())
            client_.emplace(session);
        else
            server_.emplace(session);
    }
    void send(std::uint64_t sequence) {
        if (client_)
            answer_ = client_->call(sequence);
        else
            server_->reply(sequence);
    }
    std::uint64_t receive() { return client_ ? answer_ : server_->take(); }

  private:
    std::optional<BenchCallClient> client_;
    std::optional<BenchCallServer> server_;
    std::uint64_t answer_ = 0;
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
        call.placement = Placement::threads; // shows the cost of the process boundary itself
        registry.add(call);
    }
    registry.add({.subject = "call-queue",
                  .operation = "paired",
                  .bytes = bytes,
                  .unit = Unit::ratio,
                  .run = measure_paired_round_trips<CallEndpoint, IndexRingEndpoint<bytes, Wake::spin>>});
}

} // namespace tandem::bench
