// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/message_cursor.hpp"

#include "apps/tandem/mcap/read/log_time_order.hpp"
#include "apps/tandem/mcap/read/problems.hpp"

namespace tandem::mcap {
namespace {

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
