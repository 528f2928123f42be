// SPDX-License-Identifier: Apache-2.0
// Many data ports on one link: N rings each way are open, and the messages go through all of them in turn, or
// (1 used) all through one. The cases show the cost of unused ports and of changing ports: with 256 ports in
// turn, each message finds its cache lines only in the second-level cache.
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/registry.hpp"
#include "apps/bench/measurements/paired.hpp"
#include "apps/bench/tandem/bench_link.hpp"

namespace tandem::bench {

namespace {

constexpr std::size_t message_bytes = 64;

/// How many ports a link has, and whether only one is used.
struct PortUse {
    std::size_t ports;
    bool one_used;
};

/// The case's detail contains the number: "256 ports (1 used)".
PortUse port_use(const Case& bench_case) {
    return {std::stoul(bench_case.detail), bench_case.detail.ends_with(" (1 used)")};
}

class PortsEndpoint {
  public:
    explicit PortsEndpoint(Session& session) : PortsEndpoint(session, port_use(session.bench_case()), "") {}
    PortsEndpoint(Session& session, PortUse use, const std::string& link_suffix)
        : link_(session, use.ports * (std::size_t{80} * 1024) + (std::size_t{1} << 20U), link_suffix),
          step_(use.one_used ? 0 : 1), next_out_(use.one_used ? use.ports / 2 : 0), next_in_(next_out_) {
        for (std::size_t i = 0; i < use.ports; ++i)
            out_.emplace_back(link_.add_ring(std::to_string(i), message_bytes));
        link_.publish_and_wait();
        for (std::size_t i = 0; i < use.ports; ++i) in_.emplace_back(link_.peer_ring(std::to_string(i)));
    }

    void send(std::uint64_t sequence) {
        write_message(out_[next_out_], message_bytes, sequence);
        next_out_ = (next_out_ + step_) % out_.size();
    }
    /// Polls the port through which the next message comes, as the component with that port does.
    std::uint64_t receive() {
        for (;;) {
            const auto record = in_[next_in_].read();
            if (!record) continue;
            next_in_ = (next_in_ + step_) % in_.size();
            return checked_sequence(record->bytes.data(), message_bytes);
        }
    }

  private:
    BenchLink link_;
    std::vector<shm::RingWriter> out_;
    std::vector<shm::RingReader> in_;
    std::size_t step_, next_out_, next_in_;
};

/// A link with one port, for comparison with a link with many.
class OnePortEndpoint : public PortsEndpoint {
  public:
    OnePortEndpoint(Session& session, std::size_t /*place*/)
        : PortsEndpoint(session, {.ports = 1, .one_used = true}, "-one") {}
};

} // namespace

void add_port_cases(Registry& registry) {
    for (const char* ports : {"1 port", "4 ports", "16 ports", "64 ports", "256 ports", "256 ports (1 used)"})
        registry.add({.subject = "ring",
                      .operation = "ports",
                      .divisor = 2,
                      .detail = ports,
                      .run = measure_round_trips<PortsEndpoint>});
    for (const char* ports : {"256 ports", "256 ports (1 used)"})
        registry.add(
            {.subject = "ring",
             .operation = "paired-ports",
             .unit = Unit::ratio,
             .extra_seconds = 10,
             .detail = ports,
             .run = measure_paired_round_trips<PortsEndpoint, OnePortEndpoint, 10, HalfTime::median>});
}

} // namespace tandem::bench
