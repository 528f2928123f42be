// SPDX-License-Identifier: Apache-2.0
// The common parts of the peers' files. A peer's endpoints are templates over message size and wake mode. The
// peer is measured in the modes and with the payloads that it has.
#pragma once
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/registry.hpp"
#include "apps/bench/measurements/paired.hpp"
#include "apps/bench/tandem/ring_endpoint.hpp"

#include <stdexcept>
#include <string>
#include <vector>

namespace tandem::bench {

/// Tandem's ring with a sleeping reader, for comparison with peers that sleep. On one core, its wait mode is
/// same-core, which yields before it sleeps. The second argument, which for_each_window() passes, is unused: a new segment
/// is in another place anyway.
class SleepingTandemRing : public RingEndpoint<64, Wake::blocking> {
  public:
    SleepingTandemRing(Session& session, std::size_t /*place*/) : RingEndpoint(session, how(session)) {}

  private:
    static shm::WaitOptions how(const Session& session) {
        Case of_ring = session.bench_case();
        if (of_ring.placement == Placement::same_core) of_ring.wake = Wake::spin_then_futex;
        return wait_options(of_ring);
    }
};

/// Adds the cases of one peer. Endpoint, Client and Server are described in measurements.hpp.
class PeerCases {
  public:
    /// `daemon`: a program that must run while the peer is measured.
    PeerCases(Registry& registry, std::string subject, std::string daemon = {})
        : registry_(registry), subject_(std::move(subject)), daemon_(std::move(daemon)) {}

    /// One way, 64 B, as half a round trip. If the reader sleeps, adds the ratio to Tandem's ring, measured
    /// in alternation with it.
    template <class Endpoint>
    void add_one_way(Wake wake) {
        Case one_way = make("one-way", 64, wake);
        one_way.divisor = 2;
        one_way.run = measure_round_trips<Endpoint>;
        registry_.add_with_conditions(one_way);
        if (wake != Wake::blocking) return;
        Case paired = make("paired", 64, wake);
        paired.unit = Unit::ratio;
        paired.extra_seconds = 10;
        paired.run = measure_paired_round_trips<Endpoint, SleepingTandemRing, 1>;
        registry_.add_with_conditions(paired);
    }
    /// Request and reply, 64 B each. Detail "pair": the peer has no calls, and two messages replace a call.
    template <class Client, class Server>
    void add_call(Wake wake, const std::string& detail = {}) {
        Case call = make("call", 64, wake, detail);
        call.run = measure_calls<Client, Server>;
        registry_.add_with_conditions(call);
    }
    /// Round trips that are due every millisecond, 64 B.
    template <class Endpoint>
    void add_paced(Wake wake) {
        Case paced = make("paced", 64, wake);
        paced.run = measure_paced<Endpoint>;
        registry_.add(paced);
    }
    /// 64 B messages without a pause.
    template <class Endpoint>
    void add_small_stream(Wake wake) {
        Case stream = make("stream", 64, wake);
        stream.unit = Unit::million_messages_per_second;
        stream.run = measure_stream<Endpoint>;
        registry_.add(stream);
    }
    /// Large messages without a pause. Detail: "loan", written and read in place, or "copy".
    template <class Endpoint>
    void add_large_stream(std::size_t bytes, Wake wake, const std::string& detail) {
        Case stream = make("stream", bytes, wake, detail);
        stream.unit = Unit::gigabytes_per_second;
        stream.run = measure_stream<Endpoint>;
        registry_.add(stream);
    }

  private:
    Case make(const char* operation, std::size_t bytes, Wake wake, const std::string& detail = {}) const {
        return {.group = Group::peer,
                .subject = subject_,
                .operation = operation,
                .bytes = bytes,
                .wake = wake,
                .detail = detail,
                .daemon = daemon_};
    }
    Registry& registry_;
    std::string subject_, daemon_;
};

/// The separate copies of a message at the sender and the receiver, for transports that copy.
template <std::size_t bytes>
struct Message {
    Message() : words(bytes / sizeof(std::uint64_t)) {}
    void* data() { return words.data(); }
    void fill(std::uint64_t sequence) { fill_message(words.data(), bytes, sequence); }
    std::uint64_t checked_sequence() const { return bench::checked_sequence(words.data(), bytes); }
    std::vector<std::uint64_t> words;
};

/// Client and server of a transport without calls: a message there and one back.
template <class Endpoint>
struct PairClientOf : Endpoint {
    using Endpoint::Endpoint;
    std::uint64_t call(std::uint64_t sequence) {
        this->send(sequence);
        return this->receive();
    }
};
template <class Endpoint>
struct PairServerOf : Endpoint {
    using Endpoint::Endpoint;
    std::uint64_t serve() {
        const std::uint64_t sequence = this->receive();
        this->send(sequence);
        return sequence;
    }
};

} // namespace tandem::bench
