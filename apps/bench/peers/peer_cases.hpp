// SPDX-License-Identifier: Apache-2.0
// What the cases of all peers have in common. A peer is measured in the wake modes and with the payloads that
// it has; its Ends are templates over message size and wake mode.
#pragma once
#include "apps/bench/harness/measurements.hpp"

namespace tandem::bench {

constexpr std::size_t mebibyte = std::size_t{1} << 20U;

class PeerCases {
  public:
    PeerCases(Registry& registry, std::string who, std::string service = {})
        : registry_(registry), who_(std::move(who)), service_(std::move(service)) {}

    /// One way, 64 B, by round trip.
    template <class End>
    void one_way(Wake wake, const std::string& detail = {}) {
        Case one = base("one-way", 64, wake, detail);
        one.divisor = 2;
        one.run = echo<End>;
        registry_.add_regimes(one);
    }
    /// Request and reply, 64 B each.
    template <class Client, class Server>
    void call(Wake wake, const std::string& detail = {}) {
        Case one = base("call", 64, wake, detail);
        one.run = calls<Client, Server>;
        registry_.add_regimes(one);
    }
    /// Round trips that are due every millisecond.
    template <class End>
    void due(Wake wake) {
        Case one = base("paced", 64, wake, {});
        one.run = paced<End>;
        registry_.cases.push_back(one);
    }
    template <class End>
    void rate(Wake wake, const std::string& detail = {}) {
        Case one = base("stream", 64, wake, detail);
        one.unit = Unit::megamessages;
        one.run = stream<End>;
        registry_.cases.push_back(one);
    }
    template <class End>
    void large(std::size_t bytes, Wake wake, const std::string& detail = {}) {
        Case one = base("stream", bytes, wake, detail);
        one.unit = Unit::gigabytes;
        one.run = stream<End>;
        registry_.cases.push_back(one);
    }

  private:
    Case base(const char* what, std::size_t bytes, Wake wake, const std::string& detail) const {
        Case one;
        one.group = Group::peer;
        one.who = who_;
        one.what = what;
        one.bytes = bytes;
        one.wake = wake;
        one.detail = detail;
        one.service = service_;
        return one;
    }
    Registry& registry_;
    std::string who_, service_;
};

/// A private message for transports that copy.
template <std::size_t bytes>
struct Message {
    Message() : words(bytes / sizeof(std::uint64_t)) {}
    void* data() { return words.data(); }
    void write(std::uint64_t sequence) { fill(words.data(), bytes, sequence); }
    std::uint64_t read() const { return sequence_of(words.data(), bytes); }
    std::vector<std::uint64_t> words;
};

/// Client and server of a transport that has no calls of its own: a message there and one back.
template <class End>
struct PairClientOf : End {
    using End::End;
    std::uint64_t call(std::uint64_t sequence) {
        this->send(sequence);
        return this->receive();
    }
};
template <class End>
struct PairServerOf : End {
    using End::End;
    std::uint64_t serve() {
        const std::uint64_t sequence = this->receive();
        this->send(sequence);
        return sequence;
    }
};

} // namespace tandem::bench
