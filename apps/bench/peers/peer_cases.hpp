// SPDX-License-Identifier: Apache-2.0
// What the cases of all peers have in common. A peer is measured in the wake modes and with the payloads that
// it has; its Ends are templates over message size and wake mode.
#pragma once
#include "apps/bench/harness/measurements.hpp"

namespace tandem::bench {

constexpr std::size_t mebibyte = std::size_t{1} << 20U;

class PeerCases {
  public:
    PeerCases(Registry& registry, std::string subject, std::string service = {})
        : registry_(registry), subject_(std::move(subject)), service_(std::move(service)) {}

    /// One way, 64 B, by round trip.
    template <class Endpoint>
    void one_way(Wake wake, const std::string& detail = {}) {
        Case entry = base("one-way", 64, wake, detail);
        entry.divisor = 2;
        entry.run = measure_round_trips<Endpoint>;
        registry_.add_regimes(entry);
    }
    /// Request and reply, 64 B each.
    template <class Client, class Server>
    void call(Wake wake, const std::string& detail = {}) {
        Case entry = base("call", 64, wake, detail);
        entry.run = measure_calls<Client, Server>;
        registry_.add_regimes(entry);
    }
    /// Round trips that are due every millisecond.
    template <class Endpoint>
    void due(Wake wake) {
        Case entry = base("paced", 64, wake, {});
        entry.run = measure_paced<Endpoint>;
        registry_.cases.push_back(entry);
    }
    template <class Endpoint>
    void rate(Wake wake, const std::string& detail = {}) {
        Case entry = base("stream", 64, wake, detail);
        entry.unit = Unit::megamessages;
        entry.run = measure_stream<Endpoint>;
        registry_.cases.push_back(entry);
    }
    template <class Endpoint>
    void large(std::size_t bytes, Wake wake, const std::string& detail = {}) {
        Case entry = base("stream", bytes, wake, detail);
        entry.unit = Unit::gigabytes;
        entry.run = measure_stream<Endpoint>;
        registry_.cases.push_back(entry);
    }

  private:
    Case base(const char* operation, std::size_t bytes, Wake wake, const std::string& detail) const {
        Case entry;
        entry.group = Group::peer;
        entry.subject = subject_;
        entry.operation = operation;
        entry.bytes = bytes;
        entry.wake = wake;
        entry.detail = detail;
        entry.service = service_;
        return entry;
    }
    Registry& registry_;
    std::string subject_, service_;
};

/// A private message for transports that copy.
template <std::size_t bytes>
struct Message {
    Message() : words(bytes / sizeof(std::uint64_t)) {}
    void* data() { return words.data(); }
    void write(std::uint64_t sequence) { fill_message(words.data(), bytes, sequence); }
    std::uint64_t read() const { return checked_sequence(words.data(), bytes); }
    std::vector<std::uint64_t> words;
};

/// Client and server of a transport that has no calls of its own: a message there and one back.
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
