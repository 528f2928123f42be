// SPDX-License-Identifier: Apache-2.0
#include "shm/ring.hpp"

#include "shm/error.hpp"
#include "shm/shared_copy.hpp"

#include <bit>
#include <new>

namespace tandem::shm {
namespace {

constexpr std::uint64_t longest_record = std::uint64_t{1} << 30;
constexpr std::uint64_t largest_ring = std::uint64_t{1} << 36;
constexpr std::uint64_t longest_writer_wait = 10'000'000'000;

bool two_fit(std::uint64_t capacity, std::uint64_t max_record) {
    return capacity / 2 >= record_bytes(max_record);
}

} // namespace

std::uint64_t ring_capacity(const std::string& name, const RingOptions& options) {
    const bool sound = options.max_record <= longest_record && options.capacity <= largest_ring &&
                       options.policy <= RingPolicy::wait && options.writer <= Side::second &&
                       options.wait.count() >= 0 &&
                       static_cast<std::uint64_t>(options.wait.count()) <= longest_writer_wait;
    if (!sound)
        throw Error("ring '" + name +
                    "': max_record up to 1 GiB, capacity up to 64 GiB and wait of 0 to 10 s expected");
    return std::bit_ceil(std::max<std::uint64_t>(options.capacity, 2 * record_bytes(options.max_record)));
}

RingHandle create_ring(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                       const RingOptions& options) {
    auto* header = new (memory.data()) layout::RingHeader{};
    header->capacity = memory.size() - sizeof(layout::RingHeader);
    header->max_record = options.max_record;
    header->policy = static_cast<std::uint32_t>(options.policy);
    header->writer = static_cast<std::uint32_t>(options.writer);
    header->wait_ns = static_cast<std::uint64_t>(options.wait.count());
    return {std::move(mapping),
            header,
            memory.data() + sizeof *header,
            header->capacity,
            header->max_record,
            header->wait_ns,
            options.policy,
            options.writer};
}

RingHandle open_ring(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                     const std::string& name) {
    struct {
        std::uint64_t capacity, max_record;
        std::uint32_t policy, writer;
        std::uint64_t wait_ns;
    } copy{};
    if (memory.size() >= sizeof(layout::RingHeader)) copy_from_shared(&copy, memory.data(), sizeof copy);
    const bool sound = copy.capacity == memory.size() - sizeof(layout::RingHeader) &&
                       std::has_single_bit(copy.capacity) && copy.max_record <= longest_record &&
                       two_fit(copy.capacity, copy.max_record) && copy.policy <= 3 && copy.writer <= 1 &&
                       copy.wait_ns <= longest_writer_wait;
    if (!sound)
        throw Error(mapping->path() + ": ring '" + name + "' is damaged; restart the side that made it");
    auto* header = reinterpret_cast<layout::RingHeader*>(memory.data());
    return {std::move(mapping),
            header,
            memory.data() + sizeof *header,
            copy.capacity,
            copy.max_record,
            copy.wait_ns,
            static_cast<RingPolicy>(copy.policy),
            static_cast<Side>(copy.writer)};
}

RingCounters read_counters(const RingHandle& ring) {
    const auto& shared = *ring.shared;
    const auto get = [](const layout::Word64& word) { return word.load(std::memory_order_relaxed); };
    return {get(shared.sent),     get(shared.refused),    get(shared.overwritten),   get(shared.skipped),
            get(shared.received), get(shared.bytes_sent), get(shared.bytes_received)};
}

} // namespace tandem::shm
