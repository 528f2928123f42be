// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/message_cursor.hpp"

#include "apps/tandem/mcap/read/problems.hpp"

#include <algorithm>

namespace tandem::mcap {
namespace {

constexpr std::uint64_t max_loaded = 1UL << 30U;

/// Merges the messages of blocks by log time. Loads a block when no earlier message is left.
class LogTimeOrder : public MessageOrder {
  public:
    explicit LogTimeOrder(BlockReader& blocks) : blocks_(blocks) {
        for (const Block& block : blocks.contents().blocks)
            if (blocks.wanted(block)) waiting_.push_back(&block);
        std::ranges::sort(waiting_, [](const Block* a, const Block* b) {
            return std::pair(a->start_time, a->offset) > std::pair(b->start_time, b->offset);
        });
    }

    std::optional<Message> next() override {
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
        while (!waiting_.empty() &&
               (heap_.empty() ||
                waiting_.back()->start_time <= heap_.front()->places[heap_.front()->next].log_time))
            load_next();
        if (heap_.empty()) return {};
        std::ranges::pop_heap(heap_, later);
        delivered_ = std::move(heap_.back());
        heap_.pop_back();
        const Place place = delivered_->places[delivered_->next++];
        return parsed<Message>(
            RecordSequence(ByteView(delivered_->records).subspan(place.offset)).next()->content);
    }

  private:
    /// A message in its block's records.
    struct Place {
        std::uint64_t log_time;
        std::size_t offset;
    };
    struct Loaded {
        const Block* block = nullptr;
        Bytes records;
        std::vector<Place> places; // ordered by time
        std::size_t next = 0;
    };
    using LoadedBlock = std::unique_ptr<Loaded>;
    static bool later(const LoadedBlock& a, const LoadedBlock& b) {
        return std::pair(a->places[a->next].log_time, a->block->offset) >
               std::pair(b->places[b->next].log_time, b->block->offset);
    }

    void load_next() {
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

    Error too_much() const {
        return blocks_.error(
            "log-time order needs more than 1 GiB because its chunks overlap in time: read it in file order");
    }

    BlockReader& blocks_;
    std::vector<const Block*> waiting_; // the last one is next
    std::vector<LoadedBlock> heap_;     // the block with the earliest message is first
    LoadedBlock delivered_;             // keeps the data of the last message valid
    std::uint64_t loaded_bytes_ = 0;
};

class FileOrder : public MessageOrder {
  public:
    explicit FileOrder(BlockReader& blocks) : blocks_(blocks) {}
    std::optional<Message> next() override {
        for (;;) {
            while (const auto record = sequence_.next())
                if (auto message = blocks_.wanted_message(*block_, *record)) return message;
            if (!next_block()) return {};
        }
    }

  private:
    bool next_block() {
        const auto& blocks = blocks_.contents().blocks;
        while (next_ < blocks.size()) {
            block_ = &blocks[next_++];
            if (!blocks_.wanted(*block_) || !blocks_.load_block(*block_, records_)) continue;
            sequence_ = RecordSequence(records_);
            return true;
        }
        sequence_ = RecordSequence({});
        return false;
    }

    BlockReader& blocks_;
    const Block* block_ = nullptr;
    std::size_t next_ = 0;
    Bytes records_;
    RecordSequence sequence_{{}};
};

} // namespace

BlockReader::BlockReader(File& file, const Contents& contents, Query query)
    : file_(file), contents_(contents), query_(std::move(query)) {}

bool BlockReader::wanted(const Block& block) const {
    return block.start_time <= query_.to && block.end_time >= query_.from;
}

bool BlockReader::load_block(const Block& block, Bytes& records) {
    try {
        load(file_, block, records);
        return true;
    } catch (const Error& error) {
        problem(block, std::string(error.what()) + ": its messages are skipped");
        return false;
    }
}

std::optional<Message> BlockReader::wanted_message(const Block& block, const RecordView& record) {
    if (record.op != OpCode::message) return {};
    if (record.content.size() < message_head_size) {
        problem(block, "has a message shorter than its fields: it is skipped");
        return {};
    }
    const auto message = parsed<Message>(record.content);
    if (message.log_time < query_.from || message.log_time > query_.to) return {};
    if (query_.channels && !query_.channels->contains(message.channel_id)) return {};
    if (contents_.channels.contains(message.channel_id)) return message;
    if (unknown_.insert(message.channel_id).second)
        problem(block, "has messages of channel " + std::to_string(message.channel_id) +
                           ", which the file does not define: they are skipped");
    return {};
}

void BlockReader::problem(const Block& block, const std::string& what) {
    const std::string name = block.chunk ? "Chunk" : "block of messages";
    add_problem(problems_,
                file_.error("the " + name + " at byte " + std::to_string(block.offset) + " " + what).what());
}

MessageCursor::MessageCursor(File& file, const Contents& contents, Query query) {
    const bool by_time = query.in_log_time_order;
    blocks_ = std::make_unique<BlockReader>(file, contents, std::move(query));
    if (by_time)
        order_ = std::make_unique<LogTimeOrder>(*blocks_);
    else
        order_ = std::make_unique<FileOrder>(*blocks_);
}

} // namespace tandem::mcap
