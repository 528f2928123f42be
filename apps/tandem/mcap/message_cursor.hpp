// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/contents.hpp"
#include "apps/tandem/mcap/format/decode.hpp"

#include <limits>
#include <memory>
#include <set>

namespace tandem::mcap {

/// Which messages, and in which order.
struct Query {
    std::uint64_t from = 0, to = std::numeric_limits<std::uint64_t>::max(); ///< log times, both included
    std::optional<std::set<std::uint16_t>> channels = {};                   ///< by id; none: all
    bool in_log_time_order =
        false; ///< messages of the same time, and otherwise all, come in the order of the file
};

/// Where a cursor gets its messages: one block after the other, or many at once, merged by time.
class MessageOrder {
  public:
    virtual ~MessageOrder() = default;
    /// The next message of the query; none at the end. It is valid until the next call.
    virtual std::optional<Message> next() = 0;
};

/// What a cursor has left to read, and the lines for what it could not read.
class BlockReader {
  public:
    BlockReader(File& file, const Contents& contents, Query query);
    const Contents& contents() const { return contents_; }
    /// Whether the block may have messages of the query.
    bool wanted(const Block& block) const;
    /// Returns false, and logs a line, if the block is damaged.
    bool load_block(const Block& block, Bytes& records);
    /// The message of the record if it is one of the query.
    std::optional<Message> wanted_message(const Block& block, const RecordView& record);
    const std::vector<std::string>& problems() const { return problems_; }
    Error error(const std::string& what) const { return file_.error(what); }

  private:
    void problem(const Block& block, const std::string& what);

    File& file_;
    const Contents& contents_;
    const Query query_;
    std::set<std::uint16_t> unknown_; // channels that have been told
    std::vector<std::string> problems_;
};

/// Goes once through the messages of a file. In the order of the file, one block is in memory; in log-time order, all
/// blocks whose times overlap, at most 1 GiB.
class MessageCursor {
  public:
    MessageCursor(File& file, const Contents& contents, Query query);
    /// The next message; none at the end. Its data are valid until the next call. Blocks and messages that are damaged
    /// are left out and told by problems(). Throws Error if the file cannot be read, or log-time order takes more memory
    /// than it may.
    std::optional<Message> next() { return order_->next(); }
    /// A line each for what has been left out so far.
    const std::vector<std::string>& problems() const { return blocks_->problems(); }

  private:
    std::unique_ptr<BlockReader> blocks_;
    std::unique_ptr<MessageOrder> order_;
};

} // namespace tandem::mcap
