// SPDX-License-Identifier: Apache-2.0
#include "shm/ring/ring.hpp"

#include "shm/os/error.hpp"
#include "shm/segment/segment_file.hpp"

#include <algorithm>
#include <bit>
#include <new>
#include <sys/mman.h>
#include <unistd.h>

namespace tandem::shm {

namespace {

constexpr std::uint64_t max_ring_bytes = std::uint64_t{1} << 29;
constexpr std::uint64_t max_chunk_bytes = std::uint64_t{1} << 30;
constexpr std::uint32_t max_chunks = 64;

/// Returns the bytes for two of the longest records and the line that is always free. A record is contiguous, so an empty
/// ring must have room for two: wherever it begins, one of them fits before or after the end of the ring.
std::uint64_t min_ring_bytes(std::uint64_t max_record) { return 2 * record_size(max_record) + layout::line; }

/// The sizes of a ring, as requested or as copied from the beginning of its RingHeader.
struct Sizes : RingSizes {
    std::uint64_t chunk_words_offset() const { return sizeof(layout::RingHeader) + capacity; }
    RingMemory memory() const {
        const std::uint64_t without_chunks = chunk_words_offset() + chunks * sizeof(layout::ChunkWords);
        // One page more than the chunks need, so that they can begin at a page at any position of the ring.
        const std::uint64_t chunk_pages = chunks == 0 ? 0 : chunks * chunk_bytes + layout::page;
        // Until there is a record, readers read only the first line.
        return {without_chunks + chunk_pages, without_chunks, sizeof(layout::RingHeader) + layout::line};
    }
};

Sizes sizes_of(const std::string& name, const RingOptions& options) {
    Sizes sizes{{0, options.max_record, round_up(options.chunk_bytes, layout::page), options.chunks,
                 static_cast<std::uint32_t>(options.writer)}};
    // Within these limits nothing overflows. Beyond them the capacity stays 0, which is invalid.
    if (options.max_record <= max_payload_in_ring && options.capacity <= max_ring_bytes)
        sizes.capacity =
            std::bit_ceil(std::max<std::uint64_t>(options.capacity, min_ring_bytes(options.max_record)));
    if (!sizes.valid())
        throw Error(
            "ring '" + name +
            "': expected max_record and a capacity with room for two of it, up to 512 MiB, and 0 or 2 to 64 "
            "chunks longer than max_record, up to 1 GiB");
    return sizes;
}

/// Also creates the pages now, rather than by page faults while the payload is written.
bool allocate(int file, std::uint64_t offset, std::byte* memory, std::uint64_t bytes) {
    if (!try_reserve(file, offset, bytes)) return false;
    const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
    const std::uint64_t before = reinterpret_cast<std::uintptr_t>(memory) % page;
    madvise(memory - before, before + bytes,
            MADV_POPULATE_WRITE); // kernels before 5.14 refuse, and create the pages one by one
    return true;
}

bool allocate_chunk(const RingView<RealAtomics>& ring, std::uint32_t chunk, std::uint64_t bytes) {
    return allocate(ring.file, ring.chunks_in_file + chunk * ring.chunk_bytes, ring.chunk(chunk), bytes);
}

RingHandle make_handle(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                       const Sizes& sizes) {
    RingView<RealAtomics> view;
    view.shared = reinterpret_cast<layout::RingHeader*>(memory.data());
    view.cells = reinterpret_cast<std::uint64_t*>(memory.data() + sizeof(layout::RingHeader));
    view.capacity = sizes.capacity;
    view.max_record = sizes.max_record;
    view.chunk_bytes = sizes.chunk_bytes;
    view.chunk_count = sizes.chunks;
    if (sizes.chunks != 0) {
        std::byte* words = memory.data() + sizes.chunk_words_offset();
        std::byte* words_end = words + sizes.chunks * sizeof(layout::ChunkWords);
        view.chunk_words = reinterpret_cast<layout::ChunkWords*>(words);
        // The mapping begins at a page, so a page of the mapping is a page of the file.
        view.chunks = words_end + (layout::page - reinterpret_cast<std::uintptr_t>(words_end) % layout::page);
        if (mapping->sparse()) view.allocate_chunk = allocate_chunk;
        view.file = mapping->fd();
        view.chunks_in_file = mapping->offset_in_file(view.chunks);
    }
    mapping->touch(memory.first(sizes.memory().idle));
    return {std::move(mapping), view, static_cast<Side>(sizes.writer)};
}

} // namespace

bool RingSizes::valid() const {
    return std::has_single_bit(capacity) && capacity <= max_ring_bytes && max_record <= max_payload_in_ring &&
           capacity >= min_ring_bytes(max_record) && writer <= 1 && chunk_bytes <= max_chunk_bytes &&
           chunk_bytes % layout::page == 0 && chunks <= max_chunks &&
           (chunks == 0 ? chunk_bytes == 0 : chunks >= 2 && chunk_bytes > max_record);
}

std::uint64_t ring_bytes(const RingSizes& sizes) { return sizes.valid() ? Sizes{sizes}.memory().total : 0; }

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
    header->writer = sizes.writer;
    return make_handle(std::move(mapping), memory, sizes);
}

RingHandle open_ring(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                     const std::string& name) {
    Sizes sizes{};
    static_assert(sizeof sizes == offsetof(layout::RingHeader, writer) + sizeof(std::uint32_t));
    if (memory.size() >= sizeof(layout::RingHeader)) copy_from_shared(&sizes, memory.data(), sizeof sizes);
    if (!sizes.valid() || memory.size() != sizes.memory().total)
        throw Error(mapping->path() + ": ring '" + name + "' is damaged; restart the side that made it");
    return make_handle(std::move(mapping), memory, sizes);
}

bool give_memory(const RingHandle& ring) {
    const auto& view = ring.view;
    auto* begin = reinterpret_cast<std::byte*>(view.shared);
    const Sizes sizes{{view.capacity, view.max_record, view.chunk_bytes, view.chunk_count, 0}};
    return allocate(ring.mapping->fd(), ring.mapping->offset_in_file(begin), begin,
                    sizes.memory().without_chunks);
}

RingCounters read_counters(const RingHandle& ring) {
    const auto& shared = *ring.view.shared;
    const auto get = [](const layout::Word64& word) { return word.load(std::memory_order_relaxed); };
    RingCounters counters{
        get(shared.sent),           get(shared.refused),
        get(shared.overwritten),    get(shared.skipped),
        get(shared.received),       get(shared.bytes_sent),
        get(shared.bytes_received), get(shared.converted_by_writer) + get(shared.converted_by_reader),
        get(shared.undecodable),    get(shared.missed_deadlines),
        get(shared.discarded),      get(shared.depth)};
    counters.skip_beyond_depth();
    return counters;
}

} // namespace tandem::shm
