// SPDX-License-Identifier: Apache-2.0
// The minimal ring: 64-byte slots, one way, in pairs for calls, and as fast as it goes.
#include "apps/bench/cases.hpp"
#include "apps/bench/index_ring.hpp"

namespace tandem::bench {

namespace {

constexpr std::uint32_t small_slots = 1024;

/// Two rings, one for each direction.
class RingEnd {
  public:
    explicit RingEnd(Session& session)
        : bytes_(session.bytes()), out_(ring(session, session.is_a() ? 0 : 1)),
          in_(ring(session, session.is_a() ? 1 : 0)) {}
    void send(std::uint64_t sequence) {
        fill(out_.claim(), bytes_, sequence);
        out_.publish();
    }
    std::uint64_t receive() {
        const std::uint64_t sequence = sequence_of(in_.next(), bytes_);
        in_.release();
        return sequence;
    }

  private:
    static std::uint32_t slots(std::size_t bytes) { return bytes <= 4096 ? small_slots : 4; }
    static IndexRing ring(Session& session, int index) {
        const std::size_t slot = std::max<std::size_t>(session.bytes(), 64);
        const std::size_t size = IndexRing::bytes(slot, slots(slot)) + 4096;
        return {session.memory().data() + static_cast<std::size_t>(index) * size, slot, slots(slot),
                session.measured().wake};
    }
    std::size_t bytes_;
    IndexRing out_, in_;
};

class PairClient : public RingEnd {
  public:
    using RingEnd::RingEnd;
    std::uint64_t call(std::uint64_t sequence) {
        send(sequence);
        return receive();
    }
};

class PairServer : public RingEnd {
  public:
    using RingEnd::RingEnd;
    std::uint64_t serve() {
        const std::uint64_t sequence = receive();
        send(sequence);
        return sequence;
    }
};

/// One copy in and one copy out, as when the slots are not the user's to keep.
class CopyingEnd {
  public:
    explicit CopyingEnd(Session& session)
        : bytes_(session.bytes()), buffer_(bytes_ / sizeof(std::uint64_t)),
          ring_(session.memory().data(), bytes_, 4, session.measured().wake) {}
    void send(std::uint64_t sequence) {
        fill(buffer_.data(), bytes_, sequence);
        std::memcpy(ring_.claim(), buffer_.data(), bytes_);
        ring_.publish();
    }
    std::uint64_t receive() {
        std::memcpy(buffer_.data(), ring_.next(), bytes_);
        ring_.release();
        return sequence_of(buffer_.data(), bytes_);
    }

  private:
    std::size_t bytes_;
    std::vector<std::uint64_t> buffer_;
    IndexRing ring_;
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

void add_latency(Registry& registry) {
    for (Wake wake : {Wake::spin, Wake::spin_then_futex, Wake::blocking}) {
        Case one = base("index-ring", "one-way", 64, wake);
        one.divisor = 2;
        one.run = echo<RingEnd>;
        registry.add_regimes(one);
        if (wake != Wake::blocking) {
            one.placement = Placement::threads;
            registry.cases.push_back(one);
            one.placement = Placement::processes;
        }
        one.regime = Regime::loaded;
        registry.cases.push_back(one);

        Case call = base("ring-pair", "call", 64, wake);
        call.run = calls<PairClient, PairServer>;
        registry.add_regimes(call);

        Case due = base("index-ring", "paced", 64, wake);
        due.run = paced<RingEnd>;
        registry.cases.push_back(due);

        Case cost = base("index-ring", "publish", 64, wake);
        cost.run = publish<RingEnd>;
        registry.cases.push_back(cost);
    }
    for (std::size_t bytes :
         {std::size_t{4096}, std::size_t{65536}, std::size_t{1} << 20U, std::size_t{6} << 20U}) {
        Case one = base("index-ring", "one-way", bytes, Wake::spin);
        one.divisor = 2;
        one.run = echo<RingEnd>;
        registry.cases.push_back(one);
    }
}

} // namespace

void add_floor_ring_cases(Registry& registry) {
    add_latency(registry);
    Case rate = base("index-ring", "stream", 64, Wake::spin);
    rate.unit = Unit::megamessages;
    rate.run = stream<RingEnd>;
    registry.cases.push_back(rate);
    for (std::size_t bytes : {std::size_t{1} << 20U, std::size_t{6} << 20U}) {
        Case large = base("index-ring", "stream", bytes, Wake::spin);
        large.unit = Unit::gigabytes;
        large.detail = "zero-copy";
        large.run = stream<RingEnd>;
        registry.cases.push_back(large);
        large.detail = "copy";
        large.run = stream<CopyingEnd>;
        registry.cases.push_back(large);
    }
}

} // namespace tandem::bench
