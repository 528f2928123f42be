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

/// A message as a RingFollower has copied it.
struct FollowedRecord {
    std::span<const std::byte> bytes; ///< 8-aligned; valid during the call
    std::uint64_t sequence;           ///< as the writer counts: 1, 2, 3 ...
    std::uint64_t stamp;              ///< as its sender has set it
};

/// Copies the messages of a ring beside its reader, in order, whether that reads them or not. Neither side notices:
/// nothing is written, woken or locked. What the writer has overwritten before it was copied is counted as lost.
///
/// What keeps a copy whole is in layout.hpp: the writer says by write_limit where it may store next, before it does, and
/// by filled_for which chunk. A copy counts if, after it was made, these words still lie ahead of it.
/// [one thread]
class RingFollower {
  public:
    /// Called with each message. Throws what it likes: the message then counts as delivered.
    using Deliver = std::function<void(const FollowedRecord&)>;

    /// Where to begin: behind the newest message, or with the oldest that is still there for the reader.
    enum class Begin { newest, oldest };

    /// `ring`: as observe() has found it in that file. Begins at once.
    RingFollower(std::shared_ptr<const ReadOnlySnapshot> file, const ObservedRing& ring,
                 Begin begin = Begin::newest);

    /// Delivers what was published since the last call or the construction, at most about `max_bytes` of it. Returns
    /// whether there may be more.
    bool poll(const Deliver& deliver, std::size_t max_bytes = std::size_t{8} << 20);

    /// Whether poll() is worth while, for who looks often: poll() reads the writer's words, whose line the writer has to take
    /// back from this core with its next message. This reads where the next record will begin, as the ring's reader does,
    /// and says yes now and then in any case: a writer that has gone round the ring since may have left anything there.
    bool may_have_come();

    std::uint64_t delivered() const { return delivered_; } ///< messages
    std::uint64_t lost() const { return lost_; }           ///< messages that were published and not delivered
    /// Whether the file has ended, or holds what no writer stores. Nothing more is delivered.
    bool damaged() const { return damaged_; }

  private:
    /// The writer's words, as they were read at one moment.
    struct WriterWords {
        std::uint64_t head = 0, newest = 0, write_limit = 0, published = 0;
    };

    bool read_words(WriterWords& words);
    std::uint64_t read_tail();
    bool ends_with(const WriterWords& words);
    bool is_whole(std::uint64_t position, const WriterWords& words) const {
        return words.write_limit <= position + capacity_;
    }
    std::size_t deliver_block(std::size_t bytes, const Deliver& deliver);
    void deliver_record(std::span<const std::byte> payload, std::uint64_t commit, std::uint64_t stamp,
                        const Deliver& deliver);
    bool copy_chunk(std::span<const std::byte> payload, std::uint64_t sequence);
    bool fail();

    std::shared_ptr<const ReadOnlySnapshot> file_;
    const std::uint64_t header_, capacity_, max_record_, chunk_bytes_;
    const std::uint32_t chunks_;
    bool damaged_ = false;
    bool counts_ = false;        ///< sequence_ is exact, so that a gap in the numbers is a loss
    std::uint64_t position_ = 0; ///< of the next record
    std::uint64_t sequence_ = 0; ///< of the last record; without counts_, near that
    std::uint64_t delivered_ = 0, lost_ = 0;
    unsigned quiet_looks_ = 0;                 ///< of may_have_come() since it has said yes
    std::vector<std::uint64_t> block_, chunk_; ///< copies; words, for their alignment
};

} // namespace tandem::shm
