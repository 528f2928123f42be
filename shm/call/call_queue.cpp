// SPDX-License-Identifier: Apache-2.0
#include "shm/call/call_queue.hpp"

#include "shm/os/error.hpp"
#include "shm/segment/segment_file.hpp"

#include <algorithm>
#include <new>

namespace tandem::shm {
namespace {

constexpr std::uint32_t max_slots = 256;
constexpr std::size_t slots_offset = sizeof(layout::CallQueueHeader) + sizeof(layout::CallTimes);

std::uint64_t short_size(std::uint64_t max_bytes) { return std::min(max_bytes, layout::short_call_bytes); }

/// Returns the bytes of one overflow buffer. A slot has less room for arguments than for results, so a buffer for the
/// longest arguments suffices for both.
std::uint64_t overflow_size(std::uint64_t max_bytes) {
    const std::uint64_t room = CallView::argument_room, bytes = short_size(max_bytes);
    return bytes > room ? round_up(bytes - room, layout::line_pair) : 0;
}

CallLoans loans_of(const Mapping& mapping, Side callers) {
    const std::uint64_t begin = round_up(mapping.memory().size(), layout::page);
    return {mapping.fd(), begin + index_of(callers) * layout::max_loan_bytes, 2 * layout::max_loan_bytes};
}

std::uint64_t without_overflow(std::uint32_t slots) {
    return slots_offset + slots * sizeof(layout::CallSlot);
}

bool allocate_overflow(const CallView& queue, std::uint32_t slot) {
    const std::uint64_t bytes = queue.overflow_cells * word_bytes;
    return try_reserve(queue.file, queue.overflow_in_file + slot * bytes, bytes);
}

CallQueueHandle make_handle(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                            const CallQueueOptions& options) {
    std::byte* at = memory.data();
    CallQueueHandle found{};
    found.view.header = reinterpret_cast<layout::CallQueueHeader*>(at);
    found.times = reinterpret_cast<layout::CallTimes*>(at + sizeof(layout::CallQueueHeader));
    found.view.slots = reinterpret_cast<layout::CallSlot*>(at + slots_offset);
    found.view.overflow = reinterpret_cast<RealAtomics::Cell*>(at + without_overflow(options.slots));
    found.view.slot_count = options.slots;
    found.view.max_bytes = options.max_bytes;
    found.view.short_bytes = short_size(options.max_bytes);
    found.view.overflow_cells = overflow_size(options.max_bytes) / word_bytes;
    found.callers = options.callers;
    found.mapping = std::move(mapping);
    if (found.mapping->sparse()) found.view.allocate_overflow = allocate_overflow;
    found.view.file = found.mapping->fd();
    found.view.loans = loans_of(*found.mapping, options.callers);
    found.view.overflow_in_file = found.mapping->offset_in_file(at + without_overflow(options.slots));
    found.mapping->touch(memory.first(without_overflow(options.slots)));
    return found;
}

} // namespace

const char* name_of(CallStatus status) {
    constexpr const char* names[] = {"ok",        "no such operation", "bad arguments", "exception",
                                     "timeout",   "peer died",         "overload",      "shut down",
                                     "not ready", "user exception",    "cancelled"};
    const auto index = static_cast<std::uint32_t>(status);
    return index < std::size(names) ? names[index] : "unknown status";
}

std::uint64_t call_queue_size(const CallQueueOptions& options) {
    if (options.slots < 1 || options.slots > max_slots || options.max_bytes > layout::max_loan_bytes ||
        options.callers > Side::second)
        return 0;
    return slots_offset + options.slots * (sizeof(layout::CallSlot) + overflow_size(options.max_bytes));
}

CallQueueMemory call_queue_memory(const std::string& name, const CallQueueOptions& options) {
    const std::uint64_t bytes = call_queue_size(options);
    if (bytes == 0)
        throw Error("call queue '" + name + "': expected 1 to " + std::to_string(max_slots) +
                    " slots, and max_bytes up to 64 MiB");
    return {bytes, without_overflow(options.slots)};
}

CallQueueHandle create_call_queue(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                                  const CallQueueOptions& options) {
    auto made = make_handle(std::move(mapping), memory, options);
    auto* header = new (made.view.header) layout::CallQueueHeader{};
    header->slot_count = options.slots;
    header->callers = static_cast<std::uint32_t>(options.callers);
    header->max_bytes = options.max_bytes;
    header->overflow_bytes = overflow_size(options.max_bytes);
    new (made.times) layout::CallTimes{};
    for (std::uint32_t i = 0; i < options.slots; ++i) new (&made.view.slots[i]) layout::CallSlot{};
    return made;
}

CallQueueHandle open_call_queue(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                                const std::string& name) {
    struct { // the first fields of CallQueueHeader
        std::uint32_t slot_count, callers;
        std::uint64_t max_bytes, overflow_bytes;
    } copy{};
    if (memory.size() >= slots_offset) copy_from_shared(&copy, memory.data(), sizeof copy);
    const CallQueueOptions options{static_cast<Side>(copy.callers), copy.slot_count, copy.max_bytes};
    const bool valid = copy.callers <= 1 && copy.overflow_bytes == overflow_size(copy.max_bytes) &&
                       memory.size() == call_queue_size(options);
    if (!valid)
        throw Error(mapping->path() + ": call queue '" + name +
                    "' is damaged; restart the side that made it");
    return make_handle(std::move(mapping), memory, options);
}

CallCounters read_counters(const CallView& queue) {
    const auto get = [](const layout::Word64& word) { return word.load(std::memory_order_relaxed); };
    CallCounters sum{};
    sum.overloads = get(queue.header->overloads);
    sum.timeouts = get(queue.header->timeouts);
    sum.cancels = get(queue.header->cancels);
    sum.expired = get(queue.header->expired);
    sum.worker_wakes = get(queue.header->worker_wakes);
    sum.caller_wakes = get(queue.header->caller_wakes);
    for (std::uint32_t i = 0; i < queue.slot_count; ++i) {
        const auto& slot = queue.slots[i];
        CallSlotWords words{};
        words.answered = slot.work.answered.load(std::memory_order_acquire);
        words.reply = slot.reply.word.load(std::memory_order_acquire);
        words.claim = slot.work.claim.load(std::memory_order_acquire);
        words.request = slot.request.word.load(std::memory_order_acquire);
        words.calls = get(slot.request.calls);
        count_slot(sum, words);
    }
    return sum;
}

CallStage stage_of(const CallSlotWords& slot) {
    if (sequence_of(slot.reply) == sequence_of(slot.request)) return CallStage::none;
    const bool claimed = is_claimed(slot.request, slot.claim);
    if (has_state(slot.request, layout::CallState::submitted))
        return claimed ? CallStage::running : CallStage::waiting;
    const bool given_up = claimed && has_state(slot.request, layout::CallState::cancelled);
    return given_up ? CallStage::given_up : CallStage::none;
}

void count_slot(CallCounters& sum, const CallSlotWords& slot) {
    const CallStage stage = stage_of(slot);
    sum.calls += slot.calls;
    sum.answered += slot.answered;
    sum.taken += slot.answered + (stage == CallStage::running || stage == CallStage::given_up ? 1 : 0);
    if (stage != CallStage::none) ++sum.in_use;
}

} // namespace tandem::shm
