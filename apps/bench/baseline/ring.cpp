// SPDX-License-Identifier: Apache-2.0
// The minimal ring: 64-byte slots, one way, in pairs for calls, and as fast as it goes.
#include "apps/bench/baseline/index_ring.hpp"
#include "apps/bench/harness/cases.hpp"

#include <cstring>

namespace tandem::bench {

namespace {

/// Two rings, one for each direction.
template <std::size_t bytes, Wake wake>
class RingEndpoint {
  public:
    explicit RingEndpoint(Session& session, std::size_t place = 0)
        : out_(memory(session, 2 * place + (session.is_a() ? 0 : 1))),
          in_(memory(session, 2 * place + (session.is_a() ? 1 : 0))) {}
    void send(std::uint64_t sequence) {
        fill_message(out_.claim(), bytes, sequence);
        out_.publish();
    }
    std::uint64_t receive() {
        const std::uint64_t sequence = checked_sequence(in_.next(), bytes);
        in_.release();
        return sequence;
    }

  private:
    using Ring = IndexRing<bytes, bytes <= 4096 ? 1024 : 4, wake>;
    static std::byte* memory(Session& session, std::size_t index) {
        constexpr std::size_t page = 4096;
        std::byte* const begin =
            session.memory().data() + index * ((Ring::memory_bytes + page) / page * page);
        for (std::size_t at = 0; at < Ring::memory_bytes; at += page) // or the first lap would be page faults
            static_cast<void>(*static_cast<volatile std::byte*>(begin + at));
        return begin;
    }
    Ring out_, in_;
};

/// One ring, for as many messages as it can carry.
class RateEndpoint {
  public:
    explicit RateEndpoint(Session& session) : ring_(session.memory().data()) {}
    void send(std::uint64_t sequence) {
        fill_message(ring_.claim(), bytes, sequence);
        ring_.publish();
    }
    std::uint64_t receive() {
        const std::uint64_t sequence = checked_sequence(ring_.next(), bytes);
        ring_.release();
        return sequence;
    }

  private:
    static constexpr std::size_t bytes = 64;
    IndexRing<bytes, 8192, Wake::spin, RingTuning::throughput> ring_;
};

/// One copy in and one copy out, as when the slots are not the user's to keep.
template <std::size_t bytes>
class CopyingEndpoint {
  public:
    explicit CopyingEndpoint(Session& session)
        : buffer_(bytes / sizeof(std::uint64_t)), ring_(session.memory().data()) {}
    void send(std::uint64_t sequence) {
        fill_message(buffer_.data(), bytes, sequence);
        std::memcpy(ring_.claim(), buffer_.data(), bytes);
        ring_.publish();
    }
    std::uint64_t receive() {
        std::memcpy(buffer_.data(), ring_.next(), bytes);
        ring_.release();
        return checked_sequence(buffer_.data(), bytes);
    }

  private:
    std::vector<std::uint64_t> buffer_;
    IndexRing<bytes, 4, Wake::spin> ring_;
};

Case base(const char* subject, const char* operation, std::size_t bytes, Wake wake) {
    Case entry;
    entry.group = Group::baseline;
    entry.subject = subject;
    entry.operation = operation;
    entry.bytes = bytes;
    entry.wake = wake;
    return entry;
}

template <Wake wake>
void round_trips_in_8_regions(Session& session) {
    measure_round_trips_in_regions<RingEndpoint<64, wake>>(session, 8);
}

template <Wake wake>
void add_wake(Registry& registry) {
    Case entry = base("index-ring", "one-way", 64, wake);
    entry.divisor = 2;
    entry.run = round_trips_in_8_regions<wake>;
    registry.add_regimes(entry);
    if (wake != Wake::blocking) {
        entry.placement = Placement::threads;
        registry.cases.push_back(entry);
        entry.placement = Placement::processes;
    }
    entry.regime = Regime::loaded;
    registry.cases.push_back(entry);

    Case call = base("ring-pair", "call", 64, wake);
    call.run = round_trips_in_8_regions<wake>; // a message there and one back is all that a call needs
    registry.add_regimes(call);

    Case due = base("index-ring", "paced", 64, wake);
    due.run = measure_paced<RingEndpoint<64, wake>>;
    registry.cases.push_back(due);

    Case cost = base("index-ring", "publish", 64, wake);
    cost.run = measure_publish<RingEndpoint<64, wake>>;
    registry.cases.push_back(cost);
}

template <std::size_t bytes>
void add_size(Registry& registry) {
    Case entry = base("index-ring", "one-way", bytes, Wake::spin);
    entry.divisor = 2;
    entry.run = measure_round_trips<RingEndpoint<bytes, Wake::spin>>;
    registry.cases.push_back(entry);
}

template <std::size_t bytes>
void add_stream(Registry& registry) {
    Case entry = base("index-ring", "stream", bytes, Wake::spin);
    entry.unit = Unit::gigabytes;
    entry.detail = "zero-copy";
    entry.run = measure_stream<RingEndpoint<bytes, Wake::spin>>;
    registry.cases.push_back(entry);
    entry.detail = "copy";
    entry.run = measure_stream<CopyingEndpoint<bytes>>;
    registry.cases.push_back(entry);
}

constexpr std::size_t mebibyte = std::size_t{1} << 20U;

} // namespace

void add_index_ring_cases(Registry& registry) {
    add_wake<Wake::spin>(registry);
    add_wake<Wake::spin_then_futex>(registry);
    add_wake<Wake::blocking>(registry);
    add_size<256>(registry);
    add_size<1024>(registry);
    add_size<4096>(registry);
    add_size<65536>(registry);
    add_size<mebibyte>(registry);
    add_size<6 * mebibyte>(registry);

    Case rate = base("index-ring", "stream", 64, Wake::spin);
    rate.unit = Unit::megamessages;
    rate.run = measure_stream<RateEndpoint>;
    registry.cases.push_back(rate);
    add_stream<65536>(registry);
    add_stream<mebibyte>(registry);
    add_stream<6 * mebibyte>(registry);
}

} // namespace tandem::bench
