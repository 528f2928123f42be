// SPDX-License-Identifier: Apache-2.0
// Internal to the call queue: the places of its parts, and the layout of arguments and results in a slot.
#pragma once
#include "shm/call/call_loans.hpp"
#include "shm/call/call_words.hpp"

namespace tandem::shm {

/// A call in progress as its caller sees it: its slot, and the request word that was submitted there.
struct CallTicket {
    std::uint32_t slot = 0;
    std::uint64_t word = 0;
    std::uint64_t begun_ns = 0, deadline_ns = 0;
    bool worker_woken = false; ///< for this call
};

/// A call in progress as its worker sees it.
struct TakenCall {
    std::uint32_t slot = 0;
    std::uint64_t word = 0; ///< the request word
    std::uint64_t deadline_ns = 0;
    const void* arguments = nullptr; ///< a private copy; valid until the answer
    bool valid = false;              ///< the queue accepts this length
    bool by_poller = false;          ///< taken by the worker that was polling
    bool by_loan = false;            ///< the arguments came by loan
    std::uint64_t taken_ns = 0;      ///< if the call is timed, see is_timed()
    std::uint64_t bytes() const { return valid ? length_of(word) : 0; }
};

/// The place of a call queue, and this process's own copy of its sizes. A template over the atomics policy, like everything
/// that accesses a slot, so that tests/shm/model runs the shipping code.
template <class A>
struct BasicCallView {
    layout::BasicCallQueueHeader<A>* header = nullptr;
    layout::BasicCallSlot<A>* slots = nullptr;
    typename A::Cell* overflow = nullptr; ///< slot_count buffers
    std::uint32_t slot_count = 0;
    std::uint64_t max_bytes = 0;
    std::uint64_t short_bytes = 0;    ///< longer payloads are passed by loan
    std::uint64_t overflow_cells = 0; ///< of each buffer
    /// In a sparse segment: gives a slot's buffer memory. Returns false if /dev/shm is full.
    bool (*allocate_overflow)(const BasicCallView&, std::uint32_t slot) = nullptr;
    int file = -1;
    std::uint64_t overflow_in_file = 0; ///< offset of the first buffer in the segment's file
    CallLoans loans;

    static constexpr std::size_t line = 64;
    static constexpr std::size_t argument_room = 11 * word_bytes; ///< in the slot itself
    static constexpr std::size_t result_room = 15 * word_bytes;

    /// Prepares a payload that is longer than the slot's own room: writes it to the slot's loan, or makes sure that the
    /// slot's buffer has memory. Returns false if there is no memory. `has_memory`: the calling side's record of whether this
    /// buffer has memory.
    bool prepare_long(std::uint32_t slot, const void* from, std::size_t bytes, bool& has_memory) const {
        if (bytes > short_bytes) return loans.write(slot, from, bytes);
        if (has_memory || allocate_overflow == nullptr) return true;
        return has_memory = allocate_overflow(*this, slot);
    }
    typename A::Cell* overflow_of(std::uint32_t slot) const { return overflow + slot * overflow_cells; }

    // Requests the second line of a request or reply, which is written before the first one. A worker does this when it has
    // found a call, a caller does it all the time while it polls the first line.
    void prefetch_request(std::uint32_t slot) const { prefetch_second_line(&slots[slot].request); }
    void prefetch_reply(std::uint32_t slot) const { prefetch_second_line(&slots[slot].reply); }

    // A worker requests both lines of the reply for writing as soon as it has taken the call. They arrive while the call
    // runs, which saves a tenth of a short call.
    void prefetch_reply_for_writing(std::uint32_t slot) const {
        __builtin_prefetch(&slots[slot].reply, 1);
        __builtin_prefetch(reinterpret_cast<const std::byte*>(&slots[slot].reply) + line, 1);
    }

    // All four copy word by word with atomic accesses, because a hostile peer may write while this side reads. The first
    // and the third omit what is passed by loan; the others are for short payloads.
    void copy_arguments_in(std::uint32_t slot, const void* from, std::size_t bytes) const {
        copy_to_slot(slots[slot].request.arguments, arguments_in_first_line, argument_room, slot, from,
                     bytes);
    }
    void copy_arguments_out(std::uint32_t slot, void* to, std::size_t bytes) const {
        copy_from_slot(slots[slot].request.arguments, argument_room, slot, to, bytes);
    }
    void copy_results_in(std::uint32_t slot, const void* from, std::size_t bytes) const {
        copy_to_slot(slots[slot].reply.results, results_in_first_line, result_room, slot, from, bytes);
    }
    void copy_results_out(std::uint32_t slot, void* to, std::size_t bytes) const {
        copy_from_slot(slots[slot].reply.results, result_room, slot, to, bytes);
    }

  private:
    static void prefetch_second_line(const void* first_line) {
        __builtin_prefetch(static_cast<const std::byte*>(first_line) + line);
    }

    // Payload bytes in the line of the request or reply word. The peer polls this line and takes it away as soon as it is
    // written, so everything else is written before.
    static constexpr std::size_t arguments_in_first_line =
        line - offsetof(layout::CallSlot, request.arguments);
    static constexpr std::size_t results_in_first_line =
        line - (offsetof(layout::CallSlot, reply.results) - offsetof(layout::CallSlot, reply));

    void copy_to_slot(typename A::Cell* cells, std::size_t first_line_bytes, std::size_t room,
                      std::uint32_t slot, const void* from, std::size_t bytes) const {
        const auto* at = static_cast<const std::byte*>(from);
        if (bytes > room) {
            if (bytes > short_bytes) return;
            A::copy_atomic_to_shared(overflow_of(slot), at + room, bytes - room);
        }
        if (bytes > first_line_bytes)
            A::copy_atomic_to_shared(cells + first_line_bytes / word_bytes, at + first_line_bytes,
                                     std::min(bytes, room) - first_line_bytes);
        A::copy_atomic_to_shared(cells, at, std::min(bytes, first_line_bytes));
    }
    void copy_from_slot(const typename A::Cell* cells, std::size_t room, std::uint32_t slot, void* to,
                        std::size_t bytes) const {
        A::copy_atomic_from_shared(to, cells, std::min(bytes, room));
        if (bytes > room)
            A::copy_atomic_from_shared(static_cast<std::byte*>(to) + room, overflow_of(slot), bytes - room);
    }
};

} // namespace tandem::shm
