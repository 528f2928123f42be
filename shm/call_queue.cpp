// SPDX-License-Identifier: Apache-2.0
#include "shm/call_queue.hpp"

#include "shm/error.hpp"
#include "shm/shared_copy.hpp"

#include <new>

namespace tandem::shm {
namespace {

constexpr std::uint32_t most_slots = 256;
constexpr std::uint64_t longest_arguments = std::uint64_t{1} << 30;

std::uint64_t slot_size(std::uint64_t max_bytes) {
    return sizeof(layout::CallSlot) + round_up(max_bytes, layout::line_pair);
}

} // namespace

const char* name_of(CallStatus status) {
    constexpr const char* names[] = {"ok",      "no such operation", "bad arguments", "exception",
                                     "timeout", "peer died",         "overload",      "shut down"};
    const auto index = static_cast<std::uint32_t>(status);
    return index < std::size(names) ? names[index] : "unknown status";
}

std::uint64_t call_queue_bytes(const std::string& name, const CallQueueOptions& options) {
    if (options.slots < 1 || options.slots > most_slots || options.max_bytes > longest_arguments ||
        options.callers > Side::second)
        throw Error("call queue '" + name + "': 1 to " + std::to_string(most_slots) +
                    " slots and max_bytes up to 1 GiB expected");
    return sizeof(layout::CallQueueHeader) + options.slots * slot_size(options.max_bytes);
}

CallQueueHandle create_call_queue(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                                  const CallQueueOptions& options) {
    auto* header = new (memory.data()) layout::CallQueueHeader{};
    header->slot_count = options.slots;
    header->callers = static_cast<std::uint32_t>(options.callers);
    header->max_bytes = options.max_bytes;
    header->slot_bytes = slot_size(options.max_bytes);
    CallQueueHandle queue{
        std::move(mapping), header,         memory.data() + sizeof *header, options.slots, options.max_bytes,
        header->slot_bytes, options.callers};
    for (std::uint32_t i = 0; i < queue.slot_count; ++i) new (&queue.slot(i)) layout::CallSlot{};
    return queue;
}

CallQueueHandle open_call_queue(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                                const std::string& name) {
    struct {
        std::uint32_t slot_count, callers;
        std::uint64_t max_bytes, slot_bytes;
    } copy{};
    if (memory.size() >= sizeof(layout::CallQueueHeader)) copy_from_shared(&copy, memory.data(), sizeof copy);
    const bool sound = copy.slot_count >= 1 && copy.slot_count <= most_slots && copy.callers <= 1 &&
                       copy.max_bytes <= longest_arguments && copy.slot_bytes == slot_size(copy.max_bytes) &&
                       memory.size() == sizeof(layout::CallQueueHeader) + copy.slot_count * copy.slot_bytes;
    if (!sound)
        throw Error(mapping->path() + ": call queue '" + name +
                    "' is damaged; restart the side that made it");
    auto* header = reinterpret_cast<layout::CallQueueHeader*>(memory.data());
    return {std::move(mapping), header,          memory.data() + sizeof *header, copy.slot_count,
            copy.max_bytes,     copy.slot_bytes, static_cast<Side>(copy.callers)};
}

CallCounters read_counters(const CallQueueHandle& queue) {
    const auto get = [](const layout::Word64& word) { return word.load(std::memory_order_relaxed); };
    const auto& shared = *queue.shared;
    CallCounters counters{get(shared.tickets), get(shared.overloads), get(shared.timeouts),
                          get(shared.taken),   get(shared.answered),  0};
    for (std::uint32_t i = 0; i < queue.slot_count; ++i)
        if (queue.slot(i).state.load(std::memory_order_relaxed) != 0) ++counters.in_use;
    return counters;
}

} // namespace tandem::shm
