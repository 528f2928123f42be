// SPDX-License-Identifier: Apache-2.0
// Views of an existing ring or call queue through other atomics, which must have the layout of those in the product.
#pragma once
#include "shm/call/call_view.hpp"
#include "shm/ring/ring_view.hpp"

namespace tandem::shm::test {

template <class A>
RingView<A> view_as(const RingView<RealAtomics>& real) {
    RingView<A> view;
    view.shared = reinterpret_cast<layout::BasicRingHeader<A>*>(real.shared);
    view.cells = real.cells;
    view.capacity = real.capacity;
    view.max_record = real.max_record;
    view.chunk_bytes = real.chunk_bytes;
    view.chunk_count = real.chunk_count;
    view.chunk_words = reinterpret_cast<layout::BasicChunkWords<A>*>(real.chunk_words);
    view.chunks = real.chunks;
    return view;
}

template <class A>
BasicCallView<A> view_as(const BasicCallView<RealAtomics>& real) {
    BasicCallView<A> view;
    view.header = reinterpret_cast<layout::BasicCallQueueHeader<A>*>(real.header);
    view.slots = reinterpret_cast<layout::BasicCallSlot<A>*>(real.slots);
    view.overflow = real.overflow;
    view.slot_count = real.slot_count;
    view.max_bytes = real.max_bytes;
    view.short_bytes = real.short_bytes;
    view.overflow_cells = real.overflow_cells;
    return view;
}

} // namespace tandem::shm::test
