// SPDX-License-Identifier: Apache-2.0
#include "shm/inspect/ring_follower.hpp"

#include "shm/inspect/read_only_snapshot.hpp"
#include "shm/os/shared_copy.hpp"
#include "shm/ring/ring_view.hpp"

#include <algorithm>
#include <cstring>

namespace tandem::shm {
namespace {

using layout::ChunkWords;
using layout::RecordKind;
using layout::RingHeader;

/// Minimum size of records that are copied at once. The longest record fits in any case.
constexpr std::size_t block_bytes = std::size_t{256} * 1024;
/// How often one poll() looks for a record that the writer does not overtake.
constexpr int max_attempts = 16;
/// may_have_come() returns true at least once in this many looks.
constexpr unsigned max_quiet_looks = 64;

std::uint64_t word_at(std::span<const std::byte> bytes, std::size_t at) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, sizeof word);
    return word;
}

} // namespace

RingFollower::RingFollower(std::shared_ptr<const ReadOnlySnapshot> file, const ObservedRing& ring,
                           Begin begin, std::shared_ptr<CopyMemory> memory)
    : file_(std::move(file)), memory_(std::move(memory)), header_(ring.file_offset), capacity_(ring.capacity),
      max_record_(ring.max_record), chunk_bytes_(ring.chunk_bytes), chunks_(ring.chunks),
      damaged_(!ring.damage.empty()) {
    WriterWords words;
    if (damaged_ || !read_words(words)) return;
    sequence_ = words.published;
    if (begin == Begin::newest) {
        position_ = words.head;
        counts_ = words.head == 0 || ends_with(words);
    } else {
        position_ = std::min(read_tail(), words.head);
    }
}

/// Returns whether words.published is the number of the record that ends at words.head, and not of the record before it.
bool RingFollower::ends_with(const WriterWords& words) {
    const auto word = file_->read_word(header_ + sizeof(RingHeader) + (words.newest & (capacity_ - 1)));
    if (!word) return fail();
    const CommitWord commit = CommitWord::unpack(*word);
    return commit.sequence == static_cast<std::uint32_t>(words.published) &&
           words.newest + record_size(commit.length) == words.head;
}

bool RingFollower::fail() {
    damaged_ = true;
    return false;
}

bool RingFollower::read_words(WriterWords& words) {
    Snapshot<RingHeader> copy;
    constexpr std::size_t from = offsetof(RingHeader, head), to = offsetof(RingHeader, sample);
    if (!file_->read(header_ + from, copy.room(from, to))) return fail();
    words = {copy.word(offsetof(RingHeader, head)), copy.word(offsetof(RingHeader, newest)),
             copy.word(offsetof(RingHeader, write_limit)), copy.word(offsetof(RingHeader, published))};
    // The writer stores these words one after the other, so newest and published may be those of the record before.
    const bool sound = words.head % layout::line == 0 && words.newest % layout::line == 0 &&
                       words.newest <= words.head && words.head >= position_;
    return sound || fail();
}

/// Returns the beginning of the oldest record that the reader has not taken.
std::uint64_t RingFollower::read_tail() {
    const auto tail = file_->read_word(header_ + offsetof(RingHeader, tail));
    if (!tail) fail();
    return tail.value_or(0) / layout::line * layout::line;
}

bool RingFollower::may_have_come() {
    // 0 until a record begins there
    const auto word = file_->read_word(header_ + sizeof(RingHeader) + (position_ & (capacity_ - 1)));
    if (word == std::uint64_t{0} && ++quiet_looks_ < max_quiet_looks) return false;
    quiet_looks_ = 0;
    return true;
}

/// Returns room for a copy; empty if no process can have stored this number of bytes in the file. Asks only when the memory must
/// grow, so sharing it bounds the memory of all followers of a segment by the memory of its file.
std::span<std::byte> RingFollower::make_room(std::vector<std::uint64_t>& memory, std::uint64_t bytes) const {
    const std::uint64_t words = round_up(bytes, word_bytes) / word_bytes;
    if (words > memory.size()) {
        if (bytes > file_->memory_bytes()) return {};
        memory.resize(words);
    }
    return std::as_writable_bytes(std::span(memory)).first(bytes);
}

bool RingFollower::poll(const Deliver& deliver, std::size_t max_bytes) {
    WriterWords words;
    if (damaged_ || !read_words(words)) return false;
    const std::uint64_t begin = position_;
    left_ = max_bytes;
    for (int attempts = 0; position_ < words.head && !damaged_;) {
        if (left_ == 0 || attempts > max_attempts) return position_ != begin;
        const std::uint64_t to_end = capacity_ - (position_ & (capacity_ - 1));
        const std::uint64_t block = std::max<std::uint64_t>(block_bytes, record_size(max_record_));
        if (is_whole(position_, words) &&
            deliver_block(std::min({words.head - position_, to_end, block}), deliver))
            continue;
        // The writer has overtaken this follower: the newest record stays longest.
        ++attempts;
        if (damaged_ || !read_words(words)) return false;
        position_ = std::max(position_, words.newest);
    }
    return false;
}

/// Copies `bytes` bytes from position_ on and delivers whole records in them, at least one. Returns false if the writer has
/// overwritten them meanwhile, or if they are damaged.
bool RingFollower::deliver_block(std::size_t bytes, const Deliver& deliver) {
    const std::span<std::byte> block = make_room(memory_->records, bytes);
    WriterWords after;
    const std::uint64_t offset = header_ + sizeof(RingHeader) + (position_ & (capacity_ - 1));
    if (block.empty() || !file_->read(offset, block)) return fail();
    if (!read_words(after) || !is_whole(position_, after)) return false;
    for (std::size_t at = 0; at + layout::line <= bytes && left_ != 0 && !damaged_;) {
        const std::uint64_t word = word_at(block, at);
        const CommitWord commit = CommitWord::unpack(word);
        if (commit.kind == RecordKind::padding) { // the next record begins at the start of the ring
            const std::uint64_t to_end = capacity_ - (position_ & (capacity_ - 1));
            position_ += to_end;
            left_ -= std::min(left_, to_end);
            break;
        }
        const std::uint64_t size = record_size(commit.length);
        if (commit.kind == RecordKind::none || commit.length > max_record_) return fail();
        if (size > bytes - at) {
            // The first record has room in the block, unless it claims more than its writer has published.
            if (at == 0) return fail();
            break; // the rest is in the next block
        }
        position_ += size;
        left_ -= std::min(left_, size);
        const std::uint64_t stamp = word_at(block, at + word_bytes);
        deliver_record(block.subspan(at + layout::record_header, commit.length), word, stamp, deliver);
        at += size;
    }
    return true;
}

void RingFollower::deliver_record(std::span<const std::byte> payload, std::uint64_t word, std::uint64_t stamp,
                                  const Deliver& deliver) {
    const CommitWord commit = CommitWord::unpack(word);
    // The commit word has the low 32 bits of the number.
    const auto step = static_cast<std::int32_t>(commit.sequence - static_cast<std::uint32_t>(sequence_));
    const std::uint64_t sequence = sequence_ + static_cast<std::uint64_t>(static_cast<std::int64_t>(step));
    if (counts_ && step <= 0) { // no writer numbers its records like this
        damaged_ = true;
        return;
    }
    if (counts_) lost_ += static_cast<std::uint64_t>(step) - 1;
    counts_ = true;
    sequence_ = sequence;
    if (commit.kind == RecordKind::chunk) {
        if (!copy_chunk(payload, sequence)) {
            ++lost_;
            return;
        }
        payload = std::as_bytes(std::span(memory_->chunk)).first(word_at(payload, word_bytes));
    }
    ++delivered_;
    deliver({payload, sequence, stamp});
}

/// Copies the content of the chunk that a record refers to. Returns false if the writer has refilled it meanwhile.
bool RingFollower::copy_chunk(std::span<const std::byte> payload, std::uint64_t sequence) {
    if (payload.size() != sizeof(ChunkReference)) return fail();
    const std::uint64_t chunk = word_at(payload, 0), bytes = word_at(payload, word_bytes);
    if (chunk >= chunks_ || bytes > chunk_bytes_) return fail();
    const std::uint64_t words = header_ + sizeof(RingHeader) + capacity_;
    const std::uint64_t words_end = words + chunks_ * sizeof(ChunkWords);
    // As in make_handle() of ring.cpp: at the next page, even if the words end at one.
    const std::uint64_t first_chunk = words_end + (layout::page - words_end % layout::page);
    const auto is_filled = [&] {
        const auto filled_for =
            file_->read_word(words + chunk * sizeof(ChunkWords) + offsetof(ChunkWords, filled_for));
        return filled_for ? *filled_for == sequence : fail();
    };
    // Also looks before the copy: records that refer to a chunk of another record cost nothing.
    if (!is_filled()) return false;
    const std::span<std::byte> content = make_room(memory_->chunk, bytes);
    if (content.size() != bytes || !file_->read(first_chunk + chunk * chunk_bytes_, content)) return fail();
    left_ -= std::min(left_, bytes);
    return is_filled();
}

} // namespace tandem::shm
