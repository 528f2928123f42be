// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/read/log_time_order.hpp"

#include <algorithm>

namespace tandem::mcap {
namespace {

constexpr std::uint64_t max_loaded = 1UL << 30U;

} // namespace

LogTimeOrder::LogTimeOrder(BlockReader& blocks) : blocks_(blocks) {
    for (const Block& block : blocks.contents().blocks)
        if (blocks.wanted(block)) waiting_.push_back(&block);
    std::ranges::sort(waiting_, [](const Block* a, const Block* b) {
        return std::pair(a->start_time, a->offset) > std::pair(b->start_time, b->offset);
    });
}

std::optional<Message> LogTimeOrder::next() {
    if (delivered_) { // goes back into the heap, or is freed
        if (delivered_->next < delivered_->places.size()) {
            heap_.push_back(std::move(delivered_));
            std::ranges::push_heap(heap_, later);
        } else {
            loaded_bytes_ -= delivered_->records.size();
            delivered_.reset();
        }
    }
    // A waiting block that starts at the same time can come first in the file.
    while (!waiting_.empty() && (heap_.empty() || waiting_.back()->start_time <=
                                                      heap_.front()->places[heap_.front()->next].log_time))
        load_next();
    if (heap_.empty()) return {};
    std::ranges::pop_heap(heap_, later);
    delivered_ = std::move(heap_.back());
    heap_.pop_back();
    const Place place = delivered_->places[delivered_->next++];
    return parsed<Message>(
        RecordSequence(ByteView(delivered_->records).subspan(place.offset)).next()->content);
}

bool LogTimeOrder::later(const LoadedBlock& a, const LoadedBlock& b) {
    return std::pair(a->places[a->next].log_time, a->block->offset) >
           std::pair(b->places[b->next].log_time, b->block->offset);
}

Error LogTimeOrder::too_much() const {
    return blocks_.error(
        "log-time order needs more than 1 GiB because its chunks overlap in time: read it in file order");
}

void LogTimeOrder::load_next() {
    auto loaded = std::make_unique<Loaded>();
    loaded->block = waiting_.back();
    waiting_.pop_back();
    // The size in the index can be too small or too large.
    if (loaded->block->uncompressed_size > max_loaded - loaded_bytes_) throw too_much();
    if (!blocks_.load_block(*loaded->block, loaded->records)) return;
    if (loaded->records.size() > max_loaded - loaded_bytes_) throw too_much();
    RecordSequence sequence(loaded->records);
    while (const auto record = sequence.next())
        if (const auto message = blocks_.wanted_message(*loaded->block, *record))
            loaded->places.push_back({message->log_time, record->offset});
    if (loaded->places.empty()) return;
    std::ranges::stable_sort(loaded->places, {}, &Place::log_time);
    loaded_bytes_ += loaded->records.size();
    heap_.push_back(std::move(loaded));
    std::ranges::push_heap(heap_, later);
}

} // namespace tandem::mcap
