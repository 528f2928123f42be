// SPDX-License-Identifier: Apache-2.0
// Many ports behind one doorbell: N rings each way are open, and the messages go round them all, or (1 used)
// all through one of them. Round 256 every message finds its lines in the second-level cache.
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/tandem/bench_link.hpp"

namespace tandem::bench {

namespace {

constexpr std::size_t bytes = 64;
constexpr unsigned doorbell_bits = shm::Doorbell::user_bits;

std::size_t ports_of(const Session& session) { return std::stoul(session.bench_case().detail); }
bool one_is_used(const Session& session) { return session.bench_case().detail.ends_with(" (1 used)"); }

class PortsEndpoint {
  public:
    explicit PortsEndpoint(Session& session)
        : how_(wait_options(session.bench_case().wake, session.bench_case().regime)),
          link_(session, ports_of(session) * (std::size_t{80} * 1024) + (std::size_t{1} << 20U)),
          step_(one_is_used(session) ? 0 : 1), next_(one_is_used(session) ? ports_of(session) / 2 : 0) {
        const std::size_t ports = ports_of(session);
        for (std::size_t i = 0; i < ports; ++i) out_.emplace_back(link_.add_ring(std::to_string(i), bytes));
        link_.open();
        for (std::size_t i = 0; i < ports; ++i) in_.emplace_back(link_.peer_ring(std::to_string(i)));
    }

    void send(std::uint64_t sequence) {
        const std::size_t port = next_;
        next_ = (next_ + step_) % out_.size();
        alignas(8) std::byte message[bytes];
        fill_message(message, bytes, sequence);
        out_[port].write(message, sequence, 0);
        link_.segment().ring_peer(static_cast<unsigned>(port % doorbell_bits));
    }

    /// The doorbell says which ports may have something; those are looked at, and no other.
    std::uint64_t receive() {
        for (;;) {
            std::uint64_t sequence = 0;
            link_.segment().doorbell().wait(std::chrono::seconds(1), how_).for_each([&](unsigned bit) {
                for (std::size_t port = bit; port < in_.size(); port += doorbell_bits)
                    if (const auto record = in_[port].read())
                        sequence = checked_sequence(record->bytes.data(), bytes);
            });
            if (sequence != 0) return sequence;
        }
    }

  private:
    shm::WaitOptions how_;
    BenchLink link_;
    std::vector<shm::RingWriter> out_;
    std::vector<shm::RingReader> in_;
    std::size_t step_, next_;
};

} // namespace

void add_tandem_port_cases(Registry& registry) {
    for (const char* ports :
         {"1 port", "4 ports", "16 ports", "64 ports", "256 ports", "256 ports (1 used)"}) {
        Case entry;
        entry.subject = "ring";
        entry.operation = "ports";
        entry.wake = Wake::spin_then_futex;
        entry.detail = ports;
        entry.divisor = 2;
        entry.run = measure_round_trips<PortsEndpoint>;
        registry.cases.push_back(entry);
    }
}

} // namespace tandem::bench
