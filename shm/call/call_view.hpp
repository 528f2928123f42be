// SPDX-License-Identifier: Apache-2.0
// Inside of the call queue: where its parts are, and how arguments and results lie in a slot.
#pragma once
#include "shm/call/call_words.hpp"

namespace tandem::shm {

/// A call in progress: its slot, and the request word that was submitted there.
struct CallTicket {
    std::uint32_t slot = 0;
    std::uint64_t word = 0;
    std::uint64_t begun_ns = 0, deadline_ns = 0;
    bool rung = false; ///< a worker was woken for it
};

/// A call that a worker has taken.
struct TakenCall {
    std::uint32_t slot = 0;
    std::uint64_t word = 0; ///< the request word as this worker has left it: running
    std::uint32_t operation = 0;
    std::uint64_t deadline_ns = 0;
    const void* arguments = nullptr; ///< private; until the answer
    bool sound = false;              ///< its length is one that the queue takes
    bool watched = false;            ///< by a worker that was polling
    std::uint64_t taken_ns = 0;
    std::uint64_t bytes() const { return sound ? length_of(word) : 0; }
};

/// A template over the atomics policy, like everything that touches a slot: what ships is what is
/// model-checked (tests/shm/model). The sizes are this process' own copies.
template <class A>
struct BasicCallView {
    layout::BasicCallQueueHeader<A>* header = nullptr;
    layout::BasicCallSlot<A>* slots = nullptr;
    typename A::Cell* overflow = nullptr; ///< slot_count buffers
    std::uint32_t slot_count = 0;
    std::uint64_t max_bytes = 0;
    std::uint64_t overflow_cells = 0; ///< of each buffer

    static constexpr std::size_t line = 64;
    static constexpr std::size_t argument_room = 11 * word_bytes; ///< in the slot itself
    static constexpr std::size_t result_room = 14 * word_bytes;

    typename A::Cell* overflow_of(std::uint32_t slot) const { return overflow + slot * overflow_cells; }

    // Ask for the second line of a request or reply, which is written before the first one: a worker when it
    // has found a call, a caller all the time while it polls the first one.
    void expect_request(std::uint32_t slot) const { fetch(&slots[slot].request); }
    void expect_reply(std::uint32_t slot) const { fetch(&slots[slot].reply); }

    // A worker asks to own both lines of the reply as soon as the call is its: they come while the call runs,
    // and the reply then needs no transfer before it is seen (a tenth of a short call).
    void own_reply(std::uint32_t slot) const {
        __builtin_prefetch(&slots[slot].reply, 1);
        __builtin_prefetch(reinterpret_cast<const std::byte*>(&slots[slot].reply) + line, 1);
    }

    // All four are word-wise atomic copies: an honest side never writes what the other reads, but a caller
    // that gives up and calls again writes while a worker may still read the arguments of before (it finds
    // out by its compare-and-swap, call_worker.hpp), and a hostile one writes whenever it likes.
    void put_arguments(std::uint32_t slot, const void* from, std::size_t bytes) const {
        put(slots[slot].request.arguments, arguments_in_line, argument_room, slot, from, bytes);
    }
    void get_arguments(std::uint32_t slot, void* to, std::size_t bytes) const {
        get(slots[slot].request.arguments, argument_room, slot, to, bytes);
    }
    void put_results(std::uint32_t slot, const void* from, std::size_t bytes) const {
        put(slots[slot].reply.results, results_in_line, result_room, slot, from, bytes);
    }
    void get_results(std::uint32_t slot, void* to, std::size_t bytes) const {
        get(slots[slot].reply.results, result_room, slot, to, bytes);
    }

  private:
    static void fetch(const void* first_line) {
        __builtin_prefetch(static_cast<const std::byte*>(first_line) + line);
    }

    // Of the bytes in the slot, those that share the line of the word. The other side polls that line, and
    // takes it away at once when it is touched: so everything else is written before.
    static constexpr std::size_t arguments_in_line = line - offsetof(layout::CallSlot, request.arguments);
    static constexpr std::size_t results_in_line =
        line - (offsetof(layout::CallSlot, reply.results) - offsetof(layout::CallSlot, reply));

    void put(typename A::Cell* cells, std::size_t in_line, std::size_t room, std::uint32_t slot,
             const void* from, std::size_t bytes) const {
        const auto* at = static_cast<const std::byte*>(from);
        if (bytes > room) A::copy_in(overflow_of(slot), at + room, bytes - room);
        if (bytes > in_line)
            A::copy_in(cells + in_line / word_bytes, at + in_line, std::min(bytes, room) - in_line);
        A::copy_in(cells, at, std::min(bytes, in_line));
    }
    void get(const typename A::Cell* cells, std::size_t room, std::uint32_t slot, void* to,
             std::size_t bytes) const {
        A::copy_out(to, cells, std::min(bytes, room));
        if (bytes > room) A::copy_out(static_cast<std::byte*>(to) + room, overflow_of(slot), bytes - room);
    }
};

} // namespace tandem::shm
