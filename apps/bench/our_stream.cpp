// SPDX-License-Identifier: Apache-2.0
// Our ring as fast as it goes: small records, and large ones in place or copied in and out.
#include "apps/bench/our_ring_end.hpp"

#include "apps/bench/cases.hpp"

#include <cstring>

namespace tandem::bench {

namespace {

class OurCopyingEnd {
  public:
    explicit OurCopyingEnd(Session& session)
        : bytes_(session.bytes()), buffer_(bytes_ / sizeof(std::uint64_t)),
          link_(session, OurLink::ring_bytes(bytes_)), out_(link_.add_ring("out", bytes_)),
          in_((link_.open(), link_.peer_ring("out"))) {}

    void send(std::uint64_t sequence) {
        fill(buffer_.data(), bytes_, sequence);
        while (!out_.write({reinterpret_cast<const std::byte*>(buffer_.data()), bytes_}, sequence, 0)) {
        }
    }
    std::uint64_t receive() {
        for (;;) {
            const auto record = in_.read();
            if (!record) continue;
            std::memcpy(buffer_.data(), record->bytes.data(), bytes_);
            return sequence_of(buffer_.data(), bytes_);
        }
    }

  private:
    std::size_t bytes_;
    std::vector<std::uint64_t> buffer_;
    OurLink link_;
    shm::RingWriter out_;
    shm::RingReader in_;
};

template <std::size_t bytes>
void add_large(Registry& registry) {
    Case one;
    one.who = "ring";
    one.what = "stream";
    one.bytes = bytes;
    one.unit = Unit::gigabytes;
    one.detail = "loan";
    one.run = stream<OurRingEnd<bytes, Wake::spin>>;
    registry.cases.push_back(one);
    one.detail = "copy";
    one.run = stream<OurCopyingEnd>;
    registry.cases.push_back(one);
}

} // namespace

void add_our_stream_cases(Registry& registry) {
    Case one;
    one.who = "ring";
    one.what = "stream";
    one.unit = Unit::megamessages;
    one.run = stream<OurRingEnd<64, Wake::spin>>;
    registry.cases.push_back(one);
    add_large<1 << 16>(registry);
    add_large<1 << 20>(registry);
    add_large<6 << 20>(registry);
}

} // namespace tandem::bench
