// SPDX-License-Identifier: Apache-2.0
#include "shm/ring/ring_writer.hpp"

#include "shm/os/error.hpp"

#include <algorithm>
#include <stdexcept>

namespace tandem::shm {

template class RingProducer<RealAtomics>;

namespace {

/// Not filled, so that it takes no memory before it is used. The line after a payload is readable (publish()).
std::unique_ptr<std::uint64_t[]> scratch_for(const RingView<RealAtomics>& ring) {
    const std::size_t bytes = payload_front + round_up(ring.max_record, word_bytes) + layout::line;
    return std::make_unique_for_overwrite<std::uint64_t[]>(bytes / word_bytes);
}

} // namespace

RingWriter::RingWriter(RingHandle ring)
    : ring_(std::move(ring)), producer_(ring_.view), scratch_(scratch_for(ring_.view)),
      has_memory_(!ring_.mapping->sparse()) {
    const std::string& path = ring_.mapping->path();
    if (ring_.writer != ring_.mapping->side())
        throw Error(path + ": a ring written by side " + name_of(ring_.writer) +
                    " cannot be written here; use RingReader");
    if (producer_.corrupt())
        throw Error(path + ": a ring to be written is damaged; leave the segment and join again");
    // Only the writer that lent the chunks knows which of them the reader still holds.
    if (ring_.view.chunk_count != 0 && ring_.view.shared->published.load(std::memory_order_relaxed) != 0)
        throw Error(
            path +
            ": a ring with chunks has only one writer in its lifetime; leave the segment and join again");
    producer_.sample_next(); // gives a port an age with its first message
}

bool RingWriter::take_memory() { return has_memory_ = give_memory(ring_); }

bool RingWriter::write(std::span<const std::byte> bytes, std::uint64_t stamp_ns) {
    if (!has_memory_ && !take_memory()) return producer_.refuse();
    return producer_.write(bytes.data(), bytes.size(), stamp_ns);
}

void RingWriter::rehearse_publish(std::size_t used) {
    if (has_memory_ || take_memory()) producer_.prefetch_next(used);
}

std::span<std::byte> RingWriter::reserve(std::size_t bytes) {
    if (!has_memory_ && !take_memory()) {
        producer_.refuse();
        return {};
    }
    using Reservation = RingProducer<RealAtomics>::Reservation;
    switch (producer_.reserve(bytes)) {
    case Reservation::chunk:
        return {producer_.chunk(), bytes};
    case Reservation::scratch:
        return scratch().first(bytes);
    case Reservation::refused:
        break;
    }
    return {};
}

bool RingWriter::commit(std::size_t used, std::uint64_t stamp_ns) {
    if (!producer_.is_open() || used > producer_.reserved_bytes())
        throw std::logic_error("RingWriter::commit: more than was reserved");
    return producer_.commit(scratch().data(), used, stamp_ns);
}

} // namespace tandem::shm
