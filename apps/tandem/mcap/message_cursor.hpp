// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/contents.hpp"
#include "apps/tandem/mcap/format/decode.hpp"

#include <limits>
#include <memory>
#include <set>

namespace tandem::mcap {

/// Selects messages and their order.
struct Query {
    std::uint64_t from = 0, to = std::numeric_limits<std::uint64_t>::max(); ///< log times, inclusive
    std::optional<std::set<std::uint16_t>> channels = {};                   ///< ids; nullopt: all
    bool in_log_time_order = false; ///< equal times in file order; false: everything in file order
};

/// Source of a cursor's messages: block by block, or several blocks merged by time.
class MessageOrder {
  public:
    virtual ~MessageOrder() = default;
    /// Returns the next message; nullopt at the end. It is valid until the next call.
    virtual std::optional<Message> next() = 0;
};

/// Reads the blocks of a query and collects the problems.
class BlockReader {
  public:
    BlockReader(File& file, const Contents& contents, Query query);
    const Contents& contents() const { return contents_; }
    /// Returns whether the block's time range overlaps the query.
    bool wanted(const Block& block) const;
    /// Returns false and adds a problem if the block is damaged.
    bool load_block(const Block& block, Bytes& records);
    /// Returns the message of the record if the query selects it.
    std::optional<Message> wanted_message(const Block& block, const RecordView& record);
    const std::vector<std::string>& problems() const { return problems_; }
    Error error(const std::string& what) const { return file_.error(what); }

  private:
    void problem(const Block& block, const std::string& what);

    File& file_;
    const Contents& contents_;
    const Query query_;
    std::set<std::uint16_t> unknown_; // already reported channels
    std::vector<std::string> problems_;
};

/// Iterates once over the messages of a file. In file order, one block is in memory; in log-time order, all blocks with
/// overlapping times, at most 1 GiB.
class MessageCursor {
  public:
    MessageCursor(File& file, const Contents& contents, Query query);
    /// Returns the next message; nullopt at the end. Its data are valid until the next call. Skips damaged blocks and
    /// messages and reports them in problems(). Throws Error if the file cannot be read or log-time order needs more
    /// than 1 GiB.
    std::optional<Message> next() { return order_->next(); }
    /// Returns a line for each problem so far.
    const std::vector<std::string>& problems() const { return blocks_->problems(); }

  private:
    std::unique_ptr<BlockReader> blocks_;
    std::unique_ptr<MessageOrder> order_;
};

} // namespace tandem::mcap
