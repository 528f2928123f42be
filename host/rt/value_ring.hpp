// SPDX-License-Identifier: Apache-2.0
// A queue of values between two threads of a process, which takes no lock: a ring as in shm/ring, for values that only
// this process can read.
//
// Each cell is one word: the position of a value, whether the value is still to be read, and the value's index. The
// reader polls the word of the next position. Neither end copies a value that the other end may use: an end that
// empties or fills a cell exchanges the value in the cell for one that it owns. So there are two more values than
// cells. A writer that finds a free cell stores its word without a locked instruction. A reader, and a writer that
// drops the oldest value, exchange the word atomically, so that each value is either read or dropped.
//
// A value is often a chain of pointers. Beside the word, the cell therefore has the addresses of the value's parts, so
// that the reader requests all of them at once. A short message, of up to 48 bytes, is in the cell itself: the reader
// needs no other cache line of the writer, and the value that belongs to the cell is not used. Only a cell that was read
// gets a short message. A reader may be copying one that is unread, and its exchange of the word says that the copy is
// whole.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <tuple>
#include <vector>

namespace tandem::rt {

/// A message that fits into a cell.
struct ShortMessage {
    static constexpr std::size_t max_bytes = 48;

    /// Copies the message to `to`. No loop, which the compiler would replace by a call, of cold code.
    void copy_to(void* to) const { copy(static_cast<std::byte*>(to), data(), bytes); }
    /// Copies at most max_bytes from `from`.
    void assign(const void* from, std::size_t size) {
        bytes = 0;
        append(from, size);
    }
    /// Adds bytes; all together are at most max_bytes.
    void append(const void* from, std::size_t size) {
        copy(reinterpret_cast<std::byte*>(words.data()) + bytes, static_cast<const std::byte*>(from), size);
        bytes += size;
    }
    const std::byte* data() const { return reinterpret_cast<const std::byte*>(words.data()); }

    std::uint64_t bytes; ///< length
    std::array<std::uint64_t, max_bytes / sizeof(std::uint64_t)> words;

  private:
    template <std::size_t part = 32>
    static void copy(std::byte* to, const std::byte* from, std::size_t size) {
        if (size & part) {
            std::memcpy(to, from, part);
            to += part;
            from += part;
        }
        if constexpr (part > 1) copy<part / 2>(to, from, size);
    }
};

/// The cells of a ValueRing. [writing thread] and [reading thread] are one thread each at a time.
class CellRing {
  public:
    /// Largest depth; an index has 20 bits.
    static constexpr std::size_t max_depth = (std::size_t{1} << 20U) - 2;
    static constexpr std::size_t line = 64;
    /// Addresses of cache lines that the reader of a value needs. They are only prefetched.
    using Parts = std::array<const void*, 4>;

    explicit CellRing(std::size_t depth);
    CellRing(const CellRing&) = delete;

    std::size_t depth() const { return cells_.size(); }
    /// Returns the number of values that can be read; approximate while both threads run. [any-thread]
    std::size_t size() const;

    /// Returns the index of the value that the writer may change until it publishes it. [writing thread]
    std::uint32_t writers() const { return writer_.value; }
    /// Returns whether the next publish() drops the oldest value. [writing thread]
    bool is_full() const { return is_unread(cells_[writer_.cell].word.load(std::memory_order_acquire)); }
    /// Appends the writer's value, and gives the writer another one. Returns whether the oldest value was dropped for
    /// it. [writing thread]
    bool publish(const Parts& parts = {}) {
        Cell& cell = cells_[writer_.cell];
        const std::uint64_t word = pack(writer_.position, true, writer_.value);
        std::uint64_t before = cell.word.load(std::memory_order_acquire);
        if (is_unread(before)) [[unlikely]] { // the reader may be copying a short message
            before = cell.word.exchange(word, std::memory_order_acq_rel);
        } else { // only this thread changes a cell that was read
            for (std::size_t i = 0; i < parts.size(); ++i)
                cell.rest[i].store(reinterpret_cast<std::uintptr_t>(parts[i]), std::memory_order_relaxed);
            cell.word.store(word, std::memory_order_release);
        }
        finish_publishing(before);
        return is_unread(before);
    }
    /// Appends a short message instead of the writer's value. Returns false, without side effects, if the oldest value would
    /// have to be dropped for it. [writing thread]
    bool publish(const ShortMessage& message) {
        Cell& cell = cells_[writer_.cell];
        const std::uint64_t before = cell.word.load(std::memory_order_acquire);
        if (is_unread(before)) [[unlikely]]
            return false;
        cell.rest.back().store(message.bytes, std::memory_order_relaxed);
        for (std::size_t i = 0; i < message.words.size(); ++i)
            cell.rest[i].store(message.words[i], std::memory_order_relaxed);
        cell.word.store(pack(writer_.position, true, writer_.value) | short_bit, std::memory_order_release);
        finish_publishing(before);
        return true;
    }

    /// Returns whether there is nothing to read. Loads one word, which stays in the cache until the writer stores it.
    /// [reading thread]
    bool empty() const {
        return !has_peeked_ && !is_unread(cells_[reader_.cell].word.load(std::memory_order_acquire));
    }
    /// Returns size(), which needs a cache line that the writer changes, only if several values wait. A single one is in a
    /// cell that the reader loads in any case. [reading thread]
    std::size_t waiting() const;
    /// Returns the address of the word that empty() loads. [reading thread]
    const void* readers_cell() const { return &cells_[reader_.cell]; }
    /// Takes the oldest value. It is short_message() or, if this is NULL, the value with the index readers(), until the next
    /// take() or peek(). Returns false if there is none. [reading thread]
    bool take() {
        if (has_peeked_) [[unlikely]]
            if (take_peeked()) return true;
        const std::uint64_t word = cells_[reader_.cell].word.load(std::memory_order_acquire);
        if (!is_unread(word)) return false;
        if (try_take(word)) [[likely]]
            return true;
        return take_overtaken();
    }
    /// Looks at the value that take() would take, which then becomes the reader's. It stays in the queue until take(), or
    /// until the writer drops it. [reading thread]
    bool peek();
    /// Returns the index of the value that was taken last. [reading thread]
    std::uint32_t readers() const { return reader_.value; }
    /// Returns the message that was taken last, if it was short. [reading thread]
    const ShortMessage* short_message() const { return has_short_ ? &shorts_[last_short_] : nullptr; }

    /// Return the index of a value relative to the next one to write or to read. [no other thread uses the ring]
    std::uint32_t writers(long offset) const;
    std::uint32_t readers(long offset);
    /// Return the message at that place if it is short: its value then holds something else. [no other thread uses the ring]
    std::optional<ShortMessage> writers_short(long offset) const;
    std::optional<ShortMessage> readers_short(long offset);
    /// Undo the last publish() or take(). [no other thread uses the ring]
    void unpublish();
    void untake();

    /// Returns how many values were published. [writing thread]
    std::uint64_t published() const { return writer_.position - cells_.size(); }
    /// Returns how many values were taken or dropped. [reading thread]
    std::uint64_t taken() const { return reader_.position - cells_.size(); }

    /// Load into the caches what publish() or take() needs. The first does not take the word's line from the reader.
    void prefetch_for_publish() const { __builtin_prefetch(&cells_[writer_.cell]); }
    void prefetch_for_take() const { __builtin_prefetch(&cells_[reader_.cell], 1); }

  private:
    static constexpr unsigned index_bits = 20, position_shift = index_bits + 2;
    static constexpr std::uint64_t unread_bit = std::uint64_t{1} << index_bits, short_bit = 2 * unread_bit;

    /// Shares its cache line with no other cell, because the writer fills one while the reader polls the next. With
    /// short_bit in the word, `rest` is a ShortMessage, its length last. Otherwise it begins with the parts.
    struct alignas(line) Cell {
        std::atomic<std::uint64_t> word;
        std::array<std::atomic<std::uint64_t>, line / sizeof(std::uint64_t) - 1> rest;
    };

    /// One end. `position` counts values, `cell` is its cell.
    struct End {
        std::uint64_t position;
        std::uint32_t cell, value;
    };

    static std::uint64_t pack(std::uint64_t position, bool unread, std::uint32_t value) {
        return position << position_shift | (unread ? unread_bit : 0) | value;
    }
    static bool is_unread(std::uint64_t word) { return (word & unread_bit) != 0; }
    static std::uint32_t index(std::uint64_t word) {
        return static_cast<std::uint32_t>(word & (unread_bit - 1));
    }
    /// Returns how far the position of a word, of which the word has 42 bits, lies behind `position`.
    static std::int64_t distance(std::uint64_t word, std::uint64_t position) {
        return static_cast<std::int64_t>((word & ~(2 * short_bit - 1)) - (position << position_shift)) >>
               position_shift;
    }
    void step(End& end) const {
        ++end.position;
        if (++end.cell == cells_.size()) end.cell = 0;
    }
    void step_back(End& end) const {
        --end.position;
        end.cell = (end.cell == 0 ? static_cast<std::uint32_t>(cells_.size()) : end.cell) - 1;
    }
    std::size_t cell_at(const End& end, long offset) const;
    void finish_publishing(std::uint64_t before) {
        writer_.value = index(before);
        step(writer_);
        published_.store(writer_.position, std::memory_order_release);
    }
    static void copy_short(const Cell& from, ShortMessage& to) {
        to.bytes = from.rest.back().load(std::memory_order_relaxed);
        for (std::size_t i = 0; i < to.words.size(); ++i)
            to.words[i] = from.rest[i].load(std::memory_order_relaxed);
    }
    static std::optional<ShortMessage> short_in(const Cell& cell, bool must_be_unread);
    /// `word`: the unread word of the reader's cell.
    bool try_take(std::uint64_t word) {
        Cell& cell = cells_[reader_.cell];
        if (distance(word, reader_.position) != 0) [[unlikely]]
            return false;
        // A component takes values until there is none.
        __builtin_prefetch(&cells_[reader_.cell + 1 == cells_.size() ? 0 : reader_.cell + 1]);
        const std::uint64_t kind = word & short_bit;
        if (kind != 0)
            copy_short(cell, shorts_[1 - last_short_]); // the last message stays until this one is taken
        else
            for (std::size_t i = 0; i < std::tuple_size_v<Parts>; ++i)
                __builtin_prefetch(
                    reinterpret_cast<const void*>(cell.rest[i].load(std::memory_order_relaxed)), 1);
        if (!cell.word.compare_exchange_strong(word, pack(reader_.position, false, reader_.value) | kind,
                                               std::memory_order_acq_rel, std::memory_order_acquire))
            [[unlikely]]
            return false;
        if (kind != 0) last_short_ = 1 - last_short_;
        has_short_ = kind != 0;
        reader_.value = index(word);
        step(reader_);
        taken_.store(reader_.position, std::memory_order_relaxed);
        return true;
    }
    bool take_peeked();
    bool catch_up();
    bool take_overtaken();
    void set_taken(std::uint64_t position) { taken_.store(position, std::memory_order_relaxed); }

    std::vector<Cell> cells_;
    // Each end has a cache line to itself.
    alignas(line) End writer_;
    std::atomic<std::uint64_t> published_; ///< writer_.position
    alignas(line) End reader_;
    std::atomic<std::uint64_t> taken_; ///< position of the next value to take, a peeked one included
    bool has_peeked_ = false;          ///< the reader's value is still in the queue
    bool has_short_ = false;           ///< the last message taken is in shorts_
    unsigned last_short_ = 0;          ///< where
    std::array<ShortMessage, 2> shorts_;
};

/// A CellRing with its values.
template <class Value>
class ValueRing : public CellRing {
  public:
    /// depth: 1 to max_depth. A full ring holds this many values.
    explicit ValueRing(std::size_t depth) : CellRing(depth), values_(depth + 2) {}

    Value& at(std::uint32_t index) { return values_[index].value; }
    /// The value that publish() appends. It holds an old value, whose memory can be used again. [writing thread]
    Value& next() { return at(writers()); }
    /// The value that was taken or looked at last. [reading thread]
    Value& last() { return at(readers()); }

  private:
    struct alignas(line) Place {
        Value value{};
    };
    std::vector<Place> values_;
};

} // namespace tandem::rt
