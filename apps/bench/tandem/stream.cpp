// SPDX-License-Identifier: Apache-2.0
// Our ring as fast as it goes: small records, and large ones in place or copied in and out.
#include "apps/bench/tandem/ring_endpoint.hpp"

#include "apps/bench/harness/cases.hpp"

#include <cstring>
#include <immintrin.h>

namespace tandem::bench {

namespace {

/// Small records, taken by the batch.
class StreamEndpoint {
  public:
    explicit StreamEndpoint(Session& session)
        : link_(session, BenchLink::ring_bytes(bytes, capacity)),
          out_(link_.add_ring("out", bytes, capacity)), in_((link_.open(), link_.peer_ring("out"))) {}

    void send(std::uint64_t sequence) {
        alignas(8) std::byte message[bytes];
        fill_message(message, bytes, sequence);
        while (!out_.write(message, sequence, 0)) {
        }
    }
    std::uint64_t receive() {
        while (next_ == taken_) {
            next_ = taken_ = 0;
            const auto keep = [this](const shm::Record& record) {
                batch_[taken_++] = checked_sequence(record.bytes.data(), bytes);
            };
            if (in_.consume(keep, std::size(batch_)) == 0) _mm_pause(); // as the floor's reader
        }
        return batch_[next_++];
    }

  private:
    static constexpr std::size_t bytes = 64, capacity = std::size_t{1024} * 1024;
    BenchLink link_;
    shm::RingWriter out_;
    shm::RingReader in_;
    std::uint64_t batch_[64] = {};
    std::size_t next_ = 0, taken_ = 0;
};

class CopyingStreamEndpoint {
  public:
    explicit CopyingStreamEndpoint(Session& session)
        : bytes_(session.bytes()), buffer_(bytes_ / sizeof(std::uint64_t)),
          link_(session, BenchLink::ring_bytes(bytes_)), out_(link_.add_ring("out", bytes_)),
          in_((link_.open(), link_.peer_ring("out"))) {}

    void send(std::uint64_t sequence) {
        fill_message(buffer_.data(), bytes_, sequence);
        while (!out_.write({reinterpret_cast<const std::byte*>(buffer_.data()), bytes_}, sequence, 0)) {
        }
    }
    std::uint64_t receive() {
        for (;;) {
            const auto record = in_.peek();
            if (!record) continue;
            std::memcpy(buffer_.data(), record->bytes.data(), bytes_);
            in_.release();
            return checked_sequence(buffer_.data(), bytes_);
        }
    }

  private:
    std::size_t bytes_;
    std::vector<std::uint64_t> buffer_;
    BenchLink link_;
    shm::RingWriter out_;
    shm::RingReader in_;
};

template <std::size_t bytes>
void add_large(Registry& registry) {
    Case entry;
    entry.subject = "ring";
    entry.operation = "stream";
    entry.bytes = bytes;
    entry.unit = Unit::gigabytes;
    entry.detail = "loan";
    entry.run = measure_stream<RingEndpoint<bytes, Wake::spin>>;
    registry.cases.push_back(entry);
    entry.detail = "copy";
    entry.run = measure_stream<CopyingStreamEndpoint>;
    registry.cases.push_back(entry);
}

} // namespace

void add_tandem_stream_cases(Registry& registry) {
    Case entry;
    entry.subject = "ring";
    entry.operation = "stream";
    entry.unit = Unit::megamessages;
    entry.run = measure_stream<StreamEndpoint>;
    registry.cases.push_back(entry);
    add_large<1 << 16>(registry);
    add_large<1 << 20>(registry);
    add_large<6 << 20>(registry);
}

} // namespace tandem::bench
