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
// that the reader requests all of them at once.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

namespace tandem::rt {

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
        for (std::size_t i = 0; i < parts.size(); ++i)
            cell.parts[i].store(parts[i], std::memory_order_relaxed);
        if (is_unread(before)) [[unlikely]]
            before = cell.word.exchange(word, std::memory_order_acq_rel);
        else // only this thread changes a cell that was read
            cell.word.store(word, std::memory_order_release);
        writer_.value = index(before);
        step(writer_);
        published_.store(writer_.position, std::memory_order_release);
        return is_unread(before);
    }

    /// Returns whether there is nothing to read. Loads one word, which stays in the cache until the writer stores it.
    /// [reading thread]
    bool empty() const {
        return !has_peeked_ && !is_unread(cells_[reader_.cell].word.load(std::memory_order_acquire));
    }
    /// Returns the address of the word that empty() loads. [reading thread]
    const void* readers_cell() const { return &cells_[reader_.cell]; }
    /// Takes the oldest value. Its index is readers() until the next take() or peek(). Returns false if there is none.
    /// [reading thread]
    bool take() {
        if (has_peeked_) [[unlikely]]
            if (take_peeked()) return true;
        const Cell& cell = cells_[reader_.cell];
        std::uint64_t word = cell.word.load(std::memory_order_acquire);
        if (!is_unread(word)) return false;
        for (const auto& part : cell.parts) __builtin_prefetch(part.load(std::memory_order_relaxed), 1);
        if (try_take(word)) [[likely]]
            return true;
        return take_overtaken();
    }
    /// Makes last() the value that take() would take, and leaves it in the queue until take(), or until the writer drops
    /// it. Returns false if the queue is empty. [reading thread]
    bool peek();
    /// Returns the index of the value that was taken last. [reading thread]
    std::uint32_t readers() const { return reader_.value; }

    /// Return the index of a value relative to the next one to write or to read. [no other thread uses the ring]
    std::uint32_t writers(long offset) const;
    std::uint32_t readers(long offset);
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
    static constexpr unsigned index_bits = 20, position_shift = index_bits + 1;
    static constexpr std::uint64_t unread_bit = std::uint64_t{1} << index_bits;

    /// Shares its cache line with no other cell, because the writer fills one while the reader polls the next.
    struct alignas(line) Cell {
        std::atomic<std::uint64_t> word;
        std::array<std::atomic<const void*>, std::tuple_size_v<Parts>> parts;
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
    /// Returns how far the position of a word, of which the word has 43 bits, lies behind `position`.
    static std::int64_t distance(std::uint64_t word, std::uint64_t position) {
        return static_cast<std::int64_t>((word & ~(2 * unread_bit - 1)) - (position << position_shift)) >>
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
    /// `word`: the unread word of the reader's cell; afterwards the present one.
    bool try_take(std::uint64_t& word) {
        if (distance(word, reader_.position) != 0) [[unlikely]]
            return false;
        if (!cells_[reader_.cell].word.compare_exchange_strong(
                word, pack(reader_.position, false, reader_.value), std::memory_order_acq_rel,
                std::memory_order_acquire)) [[unlikely]]
            return false;
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
};

/// A CellRing with its values.
template <class Value>
class ValueRing : public CellRing {
  public:
    /// depth: 1 to max_depth. A full ring holds this many values.
    explicit ValueRing(std::size_t depth) : CellRing(depth), values_(depth + 2) {}

    Value& at(std::uint32_t index) { return values_[index].value; }
    /// Returns the value that publish() appends. It holds an old value, whose memory can be reused. [writing thread]
    Value& next() { return at(writers()); }
    /// Returns the value that was taken or looked at last. [reading thread]
    Value& last() { return at(readers()); }

  private:
    struct alignas(line) Place {
        Value value{};
    };
    std::vector<Place> values_;
};

} // namespace tandem::rt
