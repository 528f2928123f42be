// SPDX-License-Identifier: Apache-2.0
// The minimal ring: 64-byte slots, one way, in pairs for calls, and as fast as it goes.
#include "apps/bench/baseline/index_ring.hpp"
#include "apps/bench/harness/cases.hpp"

#include <cstring>

namespace tandem::bench {

namespace {

/// Two rings, one for each direction.
template <std::size_t bytes, Wake wake>
class RingEnd {
  public:
    explicit RingEnd(Session& session, std::size_t place = 0)
        : out_(memory(session, 2 * place + (session.is_a() ? 0 : 1))),
          in_(memory(session, 2 * place + (session.is_a() ? 1 : 0))) {}
    void send(std::uint64_t sequence) {
        fill(out_.claim(), bytes, sequence);
        out_.publish();
    }
    std::uint64_t receive() {
        const std::uint64_t sequence = sequence_of(in_.next(), bytes);
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
class RateEnd {
  public:
    explicit RateEnd(Session& session) : ring_(session.memory().data()) {}
    void send(std::uint64_t sequence) {
        fill(ring_.claim(), bytes, sequence);
        ring_.publish();
    }
    std::uint64_t receive() {
        const std::uint64_t sequence = sequence_of(ring_.next(), bytes);
        ring_.release();
        return sequence;
    }

  private:
    static constexpr std::size_t bytes = 64;
    IndexRing<bytes, 8192, Wake::spin, RingAim::rate> ring_;
};

/// One copy in and one copy out, as when the slots are not the user's to keep.
template <std::size_t bytes>
class CopyingEnd {
  public:
    explicit CopyingEnd(Session& session)
        : buffer_(bytes / sizeof(std::uint64_t)), ring_(session.memory().data()) {}
    void send(std::uint64_t sequence) {
        fill(buffer_.data(), bytes, sequence);
        std::memcpy(ring_.claim(), buffer_.data(), bytes);
        ring_.publish();
    }
    std::uint64_t receive() {
        std::memcpy(buffer_.data(), ring_.next(), bytes);
        ring_.release();
        return sequence_of(buffer_.data(), bytes);
    }

  private:
    std::vector<std::uint64_t> buffer_;
    IndexRing<bytes, 4, Wake::spin> ring_;
};

Case base(const char* who, const char* what, std::size_t bytes, Wake wake) {
    Case one;
    one.group = Group::floor;
    one.who = who;
    one.what = what;
    one.bytes = bytes;
    one.wake = wake;
    return one;
}

template <Wake wake>
void echo_at_8_places(Session& session) {
    echo_at_places<RingEnd<64, wake>>(session, 8);
}

template <Wake wake>
void add_wake(Registry& registry) {
    Case one = base("index-ring", "one-way", 64, wake);
    one.divisor = 2;
    one.run = echo_at_8_places<wake>;
    registry.add_regimes(one);
    if (wake != Wake::blocking) {
        one.placement = Placement::threads;
        registry.cases.push_back(one);
        one.placement = Placement::processes;
    }
    one.regime = Regime::loaded;
    registry.cases.push_back(one);

    Case call = base("ring-pair", "call", 64, wake);
    call.run = echo_at_8_places<wake>; // a message there and one back is all that a call needs
    registry.add_regimes(call);

    Case due = base("index-ring", "paced", 64, wake);
    due.run = paced<RingEnd<64, wake>>;
    registry.cases.push_back(due);

    Case cost = base("index-ring", "publish", 64, wake);
    cost.run = publish<RingEnd<64, wake>>;
    registry.cases.push_back(cost);
}

template <std::size_t bytes>
void add_size(Registry& registry) {
    Case one = base("index-ring", "one-way", bytes, Wake::spin);
    one.divisor = 2;
    one.run = echo<RingEnd<bytes, Wake::spin>>;
    registry.cases.push_back(one);
}

template <std::size_t bytes>
void add_stream(Registry& registry) {
    Case one = base("index-ring", "stream", bytes, Wake::spin);
    one.unit = Unit::gigabytes;
    one.detail = "zero-copy";
    one.run = stream<RingEnd<bytes, Wake::spin>>;
    registry.cases.push_back(one);
    one.detail = "copy";
    one.run = stream<CopyingEnd<bytes>>;
    registry.cases.push_back(one);
}

constexpr std::size_t mebibyte = std::size_t{1} << 20U;

} // namespace

void add_floor_ring_cases(Registry& registry) {
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
    rate.run = stream<RateEnd>;
    registry.cases.push_back(rate);
    add_stream<65536>(registry);
    add_stream<mebibyte>(registry);
    add_stream<6 * mebibyte>(registry);
}

} // namespace tandem::bench
