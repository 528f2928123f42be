// SPDX-License-Identifier: Apache-2.0
// Tandem's ring without a pause: short messages, and large ones read in place or copied out. A data port
// drops the oldest message when its ring is full. To lose none, the reader returns credits over a second
// port, as two components with flow control do.
#include "apps/bench/baseline/stream_endpoints.hpp"
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/measurements/paired.hpp"
#include "apps/bench/measurements/ring_cases.hpp"
#include "apps/bench/tandem/ring_endpoint.hpp"
#include "shm/os/processor.hpp"

#include <cstring>

namespace tandem::bench {

namespace {

/// A sends messages; B sends credits, which say how many messages it has received so far.
template <std::size_t bytes>
class StreamEndpoint {
  public:
    explicit StreamEndpoint(Session& session)
        : link_(session, BenchLink::ring_bytes(bytes, capacity)),
          out_(link_.add_ring("out", session.is_side_a() ? bytes : sizeof(std::uint64_t), capacity)),
          in_((link_.publish_and_wait(), link_.peer_ring("out"))) {}

    void send(std::uint64_t sequence) {
        while (sent_ - credits_ >= window) update_credits();
        write_message(out_, bytes, sequence);
        ++sent_;
    }
    std::uint64_t receive() {
        return receive_with([](const void* message) { return checked_sequence(message, bytes); });
    }

  protected:
    /// Waits for a message and returns use(its first byte). The message is valid only during use().
    template <class Use>
    std::uint64_t receive_with(Use&& use) {
        for (;;) {
            const auto record = in_.read();
            if (!record) {
                // Keeps off the writer's cache line, as the minimal ring's reader does.
                if (is_short) shm::Processor::pause();
                continue;
            }
            // Before the content is used, because a large message is used for longer than the credit takes to
            // arrive.
            if (++received_ % credit_interval == 0) write_message(out_, sizeof received_, received_);
            return use(record->bytes.data());
        }
    }

  private:
    static constexpr bool is_short = bytes <= 4096;
    static constexpr std::size_t capacity = is_short ? std::size_t{1024} * 1024 : BenchLink::default_capacity;
    // Messages under way: fewer short ones than the ring holds; of large ones, all chunks except the
    // reader's.
    static constexpr std::uint64_t window = is_short ? 4096 : BenchLink::chunks - 1;
    static constexpr std::uint64_t credit_interval = is_short ? 256 : 1;

    void update_credits() {
        if (const auto credit = in_.read_newest())
            credits_ = checked_sequence(credit->bytes.data(), sizeof credits_);
    }

    // In this order, because rings are in the link's memory.
    BenchLink link_;
    shm::RingWriter out_;
    shm::RingReader in_;
    std::uint64_t sent_ = 0, credits_ = 0; // of A
    std::uint64_t received_ = 0;           // of B
};

/// Copies each message out before it is used, like a component that keeps the value.
template <std::size_t bytes>
class CopyingStreamEndpoint : public StreamEndpoint<bytes> {
  public:
    explicit CopyingStreamEndpoint(Session& session)
        : StreamEndpoint<bytes>(session), buffer_(bytes / sizeof(std::uint64_t)) {}
    std::uint64_t receive() {
        return this->receive_with([this](const void* message) {
            std::memcpy(buffer_.data(), message, bytes);
            return checked_sequence(buffer_.data(), bytes);
        });
    }

  private:
    std::vector<std::uint64_t> buffer_;
};

template <std::size_t bytes>
void add_large_streams(RingCases<RingEndpoint>& cases) {
    cases.add_large_stream<StreamEndpoint<bytes>>(bytes, "loan");
    cases.add_large_stream<CopyingStreamEndpoint<bytes>>(bytes, "copy");
}

/// Measures the time of a message beside that of the minimal ring, in alternation.
template <class Endpoint, class Floor, std::size_t places = 1>
void add_paired_stream(Registry& registry, std::size_t bytes, const std::string& detail) {
    registry.add({.subject = "ring",
                  .operation = "paired-stream",
                  .bytes = bytes,
                  .unit = Unit::ratio,
                  .extra_seconds = 30,
                  .detail = detail,
                  .run = measure_paired_streams<Endpoint, Floor, places>});
}

} // namespace

void add_stream_cases(Registry& registry) {
    RingCases<RingEndpoint> cases(registry, Group::tandem, "ring");
    cases.add_small_stream<StreamEndpoint<64>>();
    add_large_streams<65536>(cases);
    add_large_streams<mebibyte>(cases);
    add_large_streams<6 * mebibyte>(cases);
    // 48 bytes and the header of a record fill one cache line, like a slot of the floor; 64 bytes take two.
    add_paired_stream<StreamEndpoint<48>, SmallStreamEndpoint, 10>(registry, 48, "");
    add_paired_stream<StreamEndpoint<64>, SmallStreamEndpoint, 10>(registry, 64, "");
    add_paired_stream<StreamEndpoint<mebibyte>, IndexRingEndpoint<mebibyte, Wake::spin>>(registry, mebibyte,
                                                                                         "loan");
    add_paired_stream<StreamEndpoint<6 * mebibyte>, IndexRingEndpoint<6 * mebibyte, Wake::spin>>(
        registry, 6 * mebibyte, "loan");
    add_paired_stream<CopyingStreamEndpoint<mebibyte>, CopyingEndpoint<mebibyte>>(registry, mebibyte, "copy");
}

} // namespace tandem::bench
