// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/inspect/observer.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace tandem::shm {

class ReadOnlySnapshot;

/// A message as copied by a RingFollower.
struct FollowedRecord {
    std::span<const std::byte> bytes; ///< 8-aligned; valid during the call
    std::uint64_t sequence;           ///< as the writer counts: 1, 2, 3 ...
    std::uint64_t stamp;              ///< as the sender set it
};

/// Memory for copies. The followers of one segment share it, so that it does not grow with their number.
struct CopyMemory {
    std::vector<std::uint64_t> records, chunk; ///< words, for their alignment
};

/// Copies the messages of a ring in order, whether or not its reader reads them. Neither side notices: nothing is written,
/// woken or locked. Messages that the writer has overwritten before they were copied count as lost.
///
/// layout.hpp explains how a copy is known to be whole: the writer announces by write_limit where it may store next, and by
/// filled_for which chunk it fills, before it does so. A copy is valid if these words, read after the copy, are still ahead
/// of it. [one thread]
class RingFollower {
  public:
    /// Called with each message. If it throws, the message counts as delivered.
    using Deliver = std::function<void(const FollowedRecord&)>;

    /// Where to begin: after the newest message, or with the oldest message that the reader has not taken.
    enum class Begin { newest, oldest };

    /// `ring`: as observe() found it in this file. Begins at once.
    RingFollower(std::shared_ptr<const ReadOnlySnapshot> file, const ObservedRing& ring,
                 Begin begin = Begin::newest,
                 std::shared_ptr<CopyMemory> memory = std::make_shared<CopyMemory>());

    /// Delivers messages that were published since the last call or the construction. Copies `max_bytes` and one message at
    /// most, whatever the writer does meanwhile. Returns whether it has made progress and there may be more.
    bool poll(const Deliver& deliver, std::size_t max_bytes = std::size_t{8} << 20);

    /// Returns whether poll() is worthwhile, for frequent callers. poll() reads the writer's words, and the writer must
    /// take their line back with its next message. This function reads only the place where the next record will begin, as
    /// the ring's reader does. It returns true now and then in any case, because a writer that has gone round the ring may
    /// have left any bytes there.
    bool may_have_come();

    std::uint64_t delivered() const { return delivered_; } ///< messages
    std::uint64_t lost() const { return lost_; }           ///< messages overwritten before they were copied
    /// Returns true if the file has ended, or holds what no writer stores. Then nothing more is delivered.
    bool damaged() const { return damaged_; }

  private:
    /// The writer's words, read at one moment.
    struct WriterWords {
        std::uint64_t head = 0, newest = 0, write_limit = 0, published = 0;
    };

    bool read_words(WriterWords& words);
    std::uint64_t read_tail();
    bool ends_with(const WriterWords& words);
    bool is_whole(std::uint64_t position, const WriterWords& words) const {
        return words.write_limit <= position + capacity_;
    }
    bool deliver_block(std::size_t bytes, const Deliver& deliver);
    void deliver_record(std::span<const std::byte> payload, std::uint64_t commit, std::uint64_t stamp,
                        const Deliver& deliver);
    bool copy_chunk(std::span<const std::byte> payload, std::uint64_t sequence);
    std::span<std::byte> make_room(std::vector<std::uint64_t>& memory, std::uint64_t bytes) const;
    bool fail();

    std::shared_ptr<const ReadOnlySnapshot> file_;
    std::shared_ptr<CopyMemory> memory_;
    const std::uint64_t header_, capacity_, max_record_, chunk_bytes_;
    const std::uint32_t chunks_;
    bool damaged_ = false;
    bool counts_ = false;        ///< sequence_ is exact, so a gap in the numbers is a loss
    std::uint64_t position_ = 0; ///< of the next record
    std::uint64_t sequence_ = 0; ///< of the last record; without counts_, close to it
    std::uint64_t delivered_ = 0, lost_ = 0;
    unsigned quiet_looks_ = 0; ///< looks of may_have_come() since it last returned true
    std::uint64_t left_ = 0;   ///< bytes that this poll() may still deliver
};

} // namespace tandem::shm
