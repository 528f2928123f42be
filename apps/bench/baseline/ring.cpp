// SPDX-License-Identifier: Apache-2.0
// The cases of the minimal ring (index_ring.hpp): one way, as a pair of rings for calls, and streams.
#include "apps/bench/baseline/index_ring.hpp"
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/ring_cases.hpp"

#include <cstring>

namespace tandem::bench {

namespace {

template <std::size_t bytes, class Ring>
void write_slot(Ring& ring, std::uint64_t sequence) {
    fill_message(ring.claim(), bytes, sequence);
    ring.publish();
}

/// The slot is given back after its words have been summed.
template <std::size_t bytes, class Ring>
std::uint64_t read_slot(Ring& ring) {
    const std::uint64_t sequence = checked_sequence(ring.wait_for_slot(), bytes);
    ring.release();
    return sequence;
}

/// Two rings, one for each direction. A region is the place of such a pair in the session's memory.
template <std::size_t bytes, Wake wake>
class RingEndpoint {
  public:
    explicit RingEndpoint(Session& session, std::size_t region = 0)
        : out_(memory(session, 2 * region + (session.is_side_a() ? 0 : 1))),
          in_(memory(session, 2 * region + (session.is_side_a() ? 1 : 0))) {}
    void send(std::uint64_t sequence) { write_slot<bytes>(out_, sequence); }
    std::uint64_t receive() { return read_slot<bytes>(in_); }

  private:
    using Ring = IndexRing<bytes, bytes <= 4096 ? 1024 : 4, wake>;
    static std::byte* memory(Session& session, std::size_t index) {
        constexpr std::size_t page = 4096;
        std::byte* const begin =
            session.memory().data() + index * ((Ring::memory_bytes + page) / page * page);
        for (std::size_t offset = 0; offset < Ring::memory_bytes;
             offset += page) // page faults now, not in the first lap
            static_cast<void>(*static_cast<volatile std::byte*>(begin + offset));
        return begin;
    }
    Ring out_, in_;
};

/// One ring, tuned for throughput.
class SmallStreamEndpoint {
  public:
    explicit SmallStreamEndpoint(Session& session) : ring_(session.memory().data()) {}
    void send(std::uint64_t sequence) { write_slot<bytes>(ring_, sequence); }
    std::uint64_t receive() { return read_slot<bytes>(ring_); }

  private:
    static constexpr std::size_t bytes = 64;
    IndexRing<bytes, 8192, Wake::spin, RingTuning::throughput> ring_;
};

/// One copy in and one copy out, as a transport needs it that does not lend its slots to the user.
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
        std::memcpy(buffer_.data(), ring_.wait_for_slot(), bytes);
        ring_.release();
        return checked_sequence(buffer_.data(), bytes);
    }

  private:
    std::vector<std::uint64_t> buffer_;
    IndexRing<bytes, 4, Wake::spin> ring_;
};

/// In 8 places of the memory, one after the other: see measure_round_trips_in_regions().
template <Wake wake>
void measure_in_8_regions(Session& session) {
    measure_round_trips_in_regions<RingEndpoint<64, wake>>(session, 8);
}

/// The 64-byte cases of one wake mode.
template <Wake wake>
void add_wake_mode(Registry& registry) {
    RingCases<RingEndpoint>(registry, Group::baseline, "index-ring")
        .add_wake_mode<wake>(measure_in_8_regions<wake>);
    // A request and a reply, each in a ring: all that a call needs.
    registry.add_with_conditions({.group = Group::baseline,
                                  .subject = "ring-pair",
                                  .operation = "call",
                                  .wake = wake,
                                  .run = measure_in_8_regions<wake>});
}

/// "zero-copy": the slots themselves are filled and summed.
template <std::size_t bytes>
void add_large_streams(RingCases<RingEndpoint>& cases) {
    cases.add_large_stream<RingEndpoint<bytes, Wake::spin>>(bytes, "zero-copy");
    cases.add_large_stream<CopyingEndpoint<bytes>>(bytes, "copy");
}

} // namespace

void add_index_ring_cases(Registry& registry) {
    add_wake_mode<Wake::spin>(registry);
    add_wake_mode<Wake::spin_then_futex>(registry);
    add_wake_mode<Wake::blocking>(registry);
    RingCases<RingEndpoint> cases(registry, Group::baseline, "index-ring");
    cases.add_sizes_from_256();
    cases.add_small_stream<SmallStreamEndpoint>();
    add_large_streams<65536>(cases);
    add_large_streams<mebibyte>(cases);
    add_large_streams<6 * mebibyte>(cases);
}

} // namespace tandem::bench
