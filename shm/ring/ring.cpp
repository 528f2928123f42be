// SPDX-License-Identifier: Apache-2.0
#include "shm/ring/ring.hpp"

#include "shm/os/error.hpp"
#include "shm/segment/segment_file.hpp"

#include <bit>
#include <new>
#include <stdexcept>
#include <sys/mman.h>

namespace tandem::shm {

template class RingProducer<RealAtomics>;
template class RingConsumer<RealAtomics>;

namespace {

constexpr std::uint64_t largest_ring = std::uint64_t{1} << 29; // lines in it < sequence_mask
constexpr std::uint64_t largest_chunk = std::uint64_t{1} << 30;
constexpr std::uint32_t most_chunks = 64;
constexpr std::uint64_t longest_writer_wait = 10'000'000'000;

/// Two of the longest records fit, and the line that is always free: so one of them finds its place,
/// contiguous, wherever an empty ring happens to begin.
std::uint64_t ring_of_two(std::uint64_t max_record) { return 2 * record_bytes(max_record) + layout::line; }

/// The sizes of a ring, as its maker wants them or as they stand in the segment.
struct Sizes {
    std::uint64_t capacity, max_record, chunk_bytes;
    std::uint32_t chunks, policy, writer, unused;
    std::uint64_t wait_ns;

    bool sound() const {
        return std::has_single_bit(capacity) && capacity <= largest_ring && max_record <= longest_record &&
               capacity >= ring_of_two(max_record) && policy <= 3 && writer <= 1 &&
               wait_ns <= longest_writer_wait && chunk_bytes <= largest_chunk &&
               chunk_bytes % layout::page == 0 && chunks <= most_chunks &&
               (chunks == 0 ? chunk_bytes == 0 : chunks >= 2 && chunk_bytes > max_record);
    }
    std::uint64_t chunk_words_at() const { return sizeof(layout::RingHeader) + capacity; }
    /// One page more than the chunks need, so that they can begin at one wherever the ring lies.
    RingMemory memory() const {
        const std::uint64_t at_once = chunk_words_at() + chunks * sizeof(layout::ChunkWords);
        return {chunks == 0 ? at_once : at_once + chunks * chunk_bytes + layout::page, at_once};
    }
};

Sizes sizes_of(const std::string& name, const RingOptions& options) {
    const auto wait = static_cast<std::uint64_t>(std::max<std::int64_t>(options.wait.count(), -1));
    Sizes sizes{0,
                options.max_record,
                round_up(options.chunk_bytes, layout::page),
                options.chunks,
                static_cast<std::uint32_t>(options.policy),
                static_cast<std::uint32_t>(options.writer),
                0,
                wait};
    if (options.max_record <= longest_record && options.capacity <= largest_ring)
        sizes.capacity =
            std::bit_ceil(std::max<std::uint64_t>(options.capacity, ring_of_two(options.max_record)));
    if (!sizes.sound())
        throw Error("ring '" + name +
                    "': max_record and capacity with room for two of it up to 512 MiB, wait of 0 to 10 s, "
                    "and 0 or 2 to 64 chunks "
                    "longer than max_record, up to 1 GiB, expected");
    return sizes;
}

/// The pages are made here, too, rather than one by one while the payload is written.
bool back_chunk(const RingView<RealAtomics>& ring, std::uint32_t chunk, std::uint64_t bytes) {
    if (!try_reserve(ring.file, ring.chunks_in_file + chunk * ring.chunk_bytes, bytes)) return false;
    madvise(ring.chunk(chunk), bytes, MADV_POPULATE_WRITE); // a kernel before 5.14 makes them one by one
    return true;
}

RingHandle handle_of(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                     const Sizes& sizes) {
    RingView<RealAtomics> view;
    view.shared = reinterpret_cast<layout::RingHeader*>(memory.data());
    view.cells = reinterpret_cast<std::uint64_t*>(memory.data() + sizeof(layout::RingHeader));
    view.capacity = sizes.capacity;
    view.max_record = sizes.max_record;
    view.wait_ns = sizes.wait_ns;
    view.policy = static_cast<RingPolicy>(sizes.policy);
    view.chunk_bytes = sizes.chunk_bytes;
    view.chunk_count = sizes.chunks;
    if (sizes.chunks != 0) {
        std::byte* words = memory.data() + sizes.chunk_words_at();
        std::byte* behind = words + sizes.chunks * sizeof(layout::ChunkWords);
        view.chunk_words = reinterpret_cast<layout::ChunkWords*>(words);
        // The mapping begins at a page, so a page of the mapping is a page of the file.
        view.chunks = behind + (layout::page - reinterpret_cast<std::uintptr_t>(behind) % layout::page);
        if (mapping->sparse()) view.back = back_chunk;
        view.file = mapping->fd();
        view.chunks_in_file = mapping->place_in_file(view.chunks);
    }
    mapping->touch(memory.first(sizes.memory().at_once));
    return {std::move(mapping), view, static_cast<Side>(sizes.writer)};
}

std::vector<std::uint64_t> scratch_of(const RingView<RealAtomics>& ring) {
    const std::size_t words = round_up(ring.max_record, word_bytes) / word_bytes;
    return std::vector<std::uint64_t>(std::max<std::size_t>(words, 1));
}

} // namespace

RingMemory ring_memory(const std::string& name, const RingOptions& options) {
    return sizes_of(name, options).memory();
}

RingHandle create_ring(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                       const RingOptions& options) {
    const Sizes sizes = sizes_of("", options);
    auto* header = new (memory.data()) layout::RingHeader{};
    header->capacity = sizes.capacity;
    header->max_record = sizes.max_record;
    header->chunk_bytes = sizes.chunk_bytes;
    header->chunks = sizes.chunks;
    header->policy = sizes.policy;
    header->writer = sizes.writer;
    header->wait_ns = sizes.wait_ns;
    return handle_of(std::move(mapping), memory, sizes);
}

RingHandle open_ring(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                     const std::string& name) {
    Sizes sizes{};
    static_assert(sizeof sizes == offsetof(layout::RingHeader, wait_ns) + 8);
    if (memory.size() >= sizeof(layout::RingHeader)) copy_from_shared(&sizes, memory.data(), sizeof sizes);
    if (!sizes.sound() || memory.size() != sizes.memory().all)
        throw Error(mapping->path() + ": ring '" + name + "' is damaged; restart the side that made it");
    return handle_of(std::move(mapping), memory, sizes);
}

RingCounters read_counters(const RingHandle& ring) {
    const auto& shared = *ring.view.shared;
    const auto get = [](const layout::Word64& word) { return word.load(std::memory_order_relaxed); };
    return {get(shared.sent),     get(shared.refused),    get(shared.overwritten),   get(shared.skipped),
            get(shared.received), get(shared.bytes_sent), get(shared.bytes_received)};
}

RingWriter::RingWriter(RingHandle ring)
    : ring_(std::move(ring)), producer_(ring_.view), scratch_(scratch_of(ring_.view)) {
    if (ring_.writer != ring_.mapping->side())
        throw Error(ring_.mapping->path() + ": a ring written by side " + name_of(ring_.writer) +
                    " cannot be written here; use RingReader");
    if (producer_.corrupt())
        throw Error(ring_.mapping->path() +
                    ": a ring to be written is damaged; leave the segment and join again");
    // Which chunks the reader still holds only the writer that lent them knows.
    if (ring_.view.chunk_count != 0 && ring_.view.shared->published.load(std::memory_order_relaxed) != 0)
        throw Error(ring_.mapping->path() +
                    ": a ring with chunks takes one writer in its life; leave the segment and join again");
}

std::span<std::byte> RingWriter::reserve(std::size_t bytes) {
    using Place = RingProducer<RealAtomics>::Place;
    switch (producer_.reserve(bytes)) {
    case Place::ring:
        return {reinterpret_cast<std::byte*>(producer_.cells()), bytes};
    case Place::chunk:
        return {producer_.chunk(), bytes};
    case Place::elsewhere:
        return {reinterpret_cast<std::byte*>(scratch_.data()), bytes};
    case Place::refused:
        break;
    }
    return {};
}

bool RingWriter::commit(std::size_t used, std::uint64_t stamp_ns, std::uint8_t tag) {
    if (!producer_.open() || used > producer_.reserved())
        throw std::logic_error("RingWriter::commit: more than was reserved");
    return producer_.commit(scratch_.data(), used, stamp_ns, tag);
}

RingReader::RingReader(RingHandle ring) : ring_(std::move(ring)), consumer_(ring_.view) {
    if (ring_.writer == ring_.mapping->side())
        throw Error(ring_.mapping->path() + ": a ring written by side " + name_of(ring_.writer) +
                    " cannot be read here; use RingWriter");
    if (consumer_.corrupt())
        throw Error(ring_.mapping->path() +
                    ": a ring to be read is damaged; leave the segment and join again");
}

std::optional<Record> RingReader::peek() {
    if (ring_.view.lossy())
        throw std::logic_error("RingReader::peek: this ring's writer overwrites; use read()");
    return consumer_.peek();
}

void RingReader::release() { consumer_.release(); }

} // namespace tandem::shm
