// SPDX-License-Identifier: Apache-2.0
// A queue between two threads of a process, which takes no lock: a ring as in shm/ring, for values that only this process
// can read.
//
// Each cell has a word: the position of a value, whether the value is still to be read, and the value's index. The reader
// polls the word of the next position. Neither end copies a value that the other end may use: an end that empties or fills a
// cell exchanges the value in the cell for one that it owns. The reader takes a value by a compare-exchange of the word.
//
// The rest of the cell's cache line holds the bytes of a short value, so that this line is the only one that a message moves
// from one processor to the other. A longer value is often a chain of pointers. Its cell has the addresses of the parts, so
// that the reader requests all of them at once.
//
// A ring of depth N has N + 1 cells. The writer fills a cell that has nothing to read. Then, if N + 1 values wait, it drops the
// oldest one, so that its next cell has nothing to read either:
//
//     writer: W1 fetch-and of the word, drops the value | W2 refills the cell     | W3 stores the word (release)
//     reader: R1 loads the word (acquire)               | R2 loads the content    | R3 compare-exchange (release)
//
// If W1 is before R3, R3 fails. If R3 is before W1, or before the load that spares W1, the writer acquires what R3 has released,
// so R2 happens before W2 and reads none of its bytes. A reader that sees that a value was dropped sees the newer one, too,
// because W1 releases it. So a ring that has a value never looks empty.
#pragma once

#include "host/rt/cycle_lines.hpp"
#include "shm/os/atomics.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <tuple>

namespace tandem::rt {

/// The cells of a ValueRing. `A`: see shm/os/atomics.hpp. [writing thread] and [reading thread] are one thread each at a time.
template <class A>
class BasicCellRing {
  public:
    /// Largest depth; an index has 20 bits.
    static constexpr std::size_t max_depth = (std::size_t{1} << 20U) - 3;
    static constexpr std::size_t line = 64;
    /// Addresses of cache lines that the reader of a value needs. They are only prefetched.
    using Parts = std::array<const void*, 4>;

    /// A copy of what a cell has beside its word: the bytes of a short value, or the parts of another.
    class Content {
      public:
        static constexpr std::size_t max_size = 48;
        std::size_t size() const { return head_ - 1; }
        const unsigned char* bytes() const { return reinterpret_cast<const unsigned char*>(words_.data()); }
        /// By words, because the code of memcpy() would be further cache lines.
        void copy_to(void* to) const { shm::RealAtomics::copy_atomic_from_shared(to, words_.data(), size()); }

      private:
        friend class BasicCellRing;
        bool is_short() const { return head_ != 0; }

        std::array<std::uint64_t, max_size / shm::word_bytes> words_;
        std::uint64_t head_ = 0; // of a short value its size + 1, else 0
    };

    explicit BasicCellRing(std::size_t depth);
    BasicCellRing(const BasicCellRing&) = delete;

    std::size_t depth() const { return cell_count_ - 1; }
    /// Returns the number of values that can be read; approximate while both threads run. [any-thread]
    std::size_t size() const;

    /// Returns the index of the value that the writer may change until it publishes it. [writing thread]
    std::uint32_t writers() const { return writer_.value; }
    /// Returns whether the next publish() drops the oldest value. [writing thread]
    bool is_full() const {
        return is_unread(cells_[cell_behind(writer_.cell)].word.load(std::memory_order_acquire));
    }
    /// Appends the writer's value, and gives the writer another one. Returns whether the oldest value was dropped for
    /// it. [writing thread]
    bool publish(const Parts& parts = {});
    /// Appends these bytes instead of the writer's value. `size` <= Content::max_size. [writing thread]
    bool publish_short(const void* bytes, std::size_t size);

    /// Returns whether there is nothing to read. Loads one word, which stays in the cache until the writer stores it.
    /// [reading thread]
    bool empty() const {
        return !has_peeked_ && is_before_reader(cells_[reader_.cell].word.load(std::memory_order_relaxed));
    }
    /// Notes the lines that empty() uses (cycle_lines.hpp). [reading thread]
    void note_lines_of_empty() const;
    /// Takes the oldest value: taken_short(), or the one with the index readers(). Returns false if there is none.
    /// [reading thread]
    bool take();
    /// Returns the value that was taken or looked at last if it is a short one, else NULL. Valid until the next take() or
    /// peek(), and until settle(). [reading thread]
    const Content* taken_short() const { return taken_.is_short() ? &taken_ : nullptr; }
    /// Gives the value that take() would take, and leaves it in the queue until take(), or until the writer drops it. Returns
    /// false if the queue is empty. [reading thread]
    bool peek();
    /// Returns the index of the value that was taken last. [reading thread]
    std::uint32_t readers() const { return reader_.value; }

    /// Moves each short value to a place with an index: calls `store(index, content)` for each. Also moves the reader over dropped
    /// values, so that size() is exact. Needed before the following functions. [no other thread uses the ring]
    template <class Store>
    void settle(const Store& store);
    /// Return the index of a value relative to the next one to write or to read. [no other thread uses the ring]
    std::uint32_t writers(long offset) const;
    std::uint32_t readers(long offset) const;
    /// Undo the last publish() or take(). [no other thread uses the ring]
    void unpublish();
    void untake();

    /// Returns how many values were published. [writing thread]
    std::uint64_t published() const { return writer_.position - cell_count_; }
    /// Returns how many values were taken or dropped. [reading thread]
    std::uint64_t taken() const { return reader_.position - cell_count_; }

    /// Load into the caches what publish() or take() needs, which includes the next cell: publish() makes room in it, and the
    /// reader looks for a further value there. The first does not take a line from the reader.
    void prefetch_for_publish() const {
        __builtin_prefetch(&cells_[writer_.cell]);
        __builtin_prefetch(&cells_[cell_behind(writer_.cell)]);
    }
    void prefetch_for_take() const {
        __builtin_prefetch(&cells_[reader_.cell], 1);
        __builtin_prefetch(&cells_[cell_behind(reader_.cell)]);
    }

  private:
    using Word = typename A::template Atomic<std::uint64_t>;
    static constexpr unsigned index_bits = 20, position_shift = index_bits + 1;
    static constexpr std::uint64_t unread_bit = std::uint64_t{1} << index_bits;

    /// Shares its cache line with no other cell, because the writer fills one while the reader polls the next.
    struct alignas(line) Cell {
        Word word;
        Word head{0};                                                            // Content::head_
        std::array<typename A::Cell, Content::max_size / shm::word_bytes> words; // Content::words_, or Parts
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
    /// Returns how far the position in a word, which has 43 bits of it, is behind `position`.
    static std::int64_t distance(std::uint64_t word, std::uint64_t position) {
        return static_cast<std::int64_t>((word & ~(2 * unread_bit - 1)) - (position << position_shift)) >>
               position_shift;
    }
    void step(End& end) const {
        ++end.position;
        end.cell = cell_behind(end.cell);
    }
    void step_back(End& end) const {
        --end.position;
        end.cell = (end.cell == 0 ? cell_count_ : end.cell) - 1;
    }
    std::uint32_t cell_behind(std::uint32_t cell) const { return cell + 1 == cell_count_ ? 0 : cell + 1; }
    std::size_t cell_at(const End& end, long offset) const;
    /// Returns whether a word of the reader's cell is of the round before, so that there is nothing to read.
    bool is_before_reader(std::uint64_t word) const { return distance(word, reader_.position) < 0; }
    template <class Fill>
    bool publish_content(const Fill& fill);
    bool make_room();
    static Content load_content(const Cell& cell);
    static void request_parts(const Content& content);
    bool try_take(std::uint64_t word);
    bool take_peeked();
    bool take_overtaken();
    void catch_up();
    void set_taken(std::uint64_t position) { next_to_take_.store(position, std::memory_order_relaxed); }
    std::optional<std::uint32_t> place_of(std::uint32_t cell) const;

    const std::uint32_t cell_count_; // depth + 1
    const std::unique_ptr<Cell[]> cells_;
    // Each end has cache lines to itself.
    alignas(line) End writer_;
    Word published_; ///< writer_.position
    alignas(line) End reader_;
    Word next_to_take_;           ///< position of the next value to take, a peeked one included
    bool has_peeked_ = false;     ///< the reader's value is still in the queue
    alignas(line) Content taken_; ///< of the value that was taken last
};

// The first values have the positions cell_count_, cell_count_ + 1 ... The words of the cells have those of one round before.
template <class A>
BasicCellRing<A>::BasicCellRing(std::size_t depth)
    : cell_count_(static_cast<std::uint32_t>(depth + 1)),
      cells_(std::make_unique<Cell[]>(cell_count_)), writer_{cell_count_, 0, cell_count_},
      published_(cell_count_), reader_{cell_count_, 0, cell_count_ + 1}, next_to_take_(cell_count_) {
    for (std::uint32_t i = 0; i < cell_count_; ++i)
        cells_[i].word.store(pack(i, false, i), std::memory_order_relaxed);
}

template <class A>
std::size_t BasicCellRing<A>::size() const {
    const std::uint64_t taken = next_to_take_.load(std::memory_order_relaxed),
                        published = published_.load(std::memory_order_acquire);
    return published > taken ? std::min<std::size_t>(published - taken, depth()) : 0;
}

template <class A>
inline bool BasicCellRing<A>::publish(const Parts& parts) {
    return publish_content([&](Cell& cell) {
        cell.head.store(0, std::memory_order_relaxed);
        for (std::size_t i = 0; i < parts.size(); ++i)
            A::store(cell.words[i], reinterpret_cast<std::uintptr_t>(parts[i]), std::memory_order_relaxed);
    });
}

template <class A>
inline bool BasicCellRing<A>::publish_short(const void* bytes, std::size_t size) {
    return publish_content([&](Cell& cell) {
        cell.head.store(size + 1, std::memory_order_relaxed);
        A::copy_atomic_to_shared(cell.words.data(), bytes, size);
    });
}

template <class A>
template <class Fill>
inline bool BasicCellRing<A>::publish_content(const Fill& fill) {
    Cell& cell = cells_[writer_.cell];
    const std::uint64_t before = cell.word.load(std::memory_order_relaxed);
    fill(cell);
    // Only this thread changes a cell that is not to be read.
    cell.word.store(pack(writer_.position, true, writer_.value), std::memory_order_release);
    writer_.value = index(before);
    step(writer_);
    published_.store(writer_.position, std::memory_order_release);
    return make_room();
}

/// Drops the value in the writer's cell, if the reader has not taken it. Returns whether it did.
template <class A>
inline bool BasicCellRing<A>::make_room() {
    Word& word = cells_[writer_.cell].word;
    if (!is_unread(word.load(std::memory_order_acquire))) [[likely]]
        return false;
    return is_unread(word.fetch_and(~unread_bit, std::memory_order_acq_rel));
}

template <class A>
void BasicCellRing<A>::note_lines_of_empty() const {
    note_lines(&cells_, sizeof cells_);
    note_lines(&reader_, sizeof reader_);
    note_lines(&cells_[reader_.cell], sizeof(Cell));
}

template <class A>
inline bool BasicCellRing<A>::take() {
    if (has_peeked_) [[unlikely]]
        if (take_peeked()) return true;
    const std::uint64_t word = cells_[reader_.cell].word.load(std::memory_order_acquire);
    if (try_take(word)) [[likely]]
        return true;
    return !is_before_reader(word) && take_overtaken();
}

/// `word`: of the reader's cell. Returns false if it is not that of the next value, or if the writer drops this value.
template <class A>
inline bool BasicCellRing<A>::try_take(std::uint64_t word) {
    if ((word ^ pack(reader_.position, true, 0)) >> index_bits != 0) return false;
    Cell& cell = cells_[reader_.cell];
    const Content content = load_content(cell);
    if (!content.is_short()) request_parts(content);
    if (!cell.word.compare_exchange_strong(word, pack(reader_.position, false, reader_.value),
                                           std::memory_order_release, std::memory_order_relaxed)) [[unlikely]]
        return false;
    taken_ = content;
    reader_.value = index(word);
    step(reader_);
    set_taken(reader_.position);
    return true;
}

template <class A>
inline typename BasicCellRing<A>::Content BasicCellRing<A>::load_content(const Cell& cell) {
    Content content;
    content.head_ = cell.head.load(std::memory_order_relaxed);
    A::copy_atomic_from_shared(content.words_.data(), cell.words.data(), Content::max_size);
    return content;
}

template <class A>
inline void BasicCellRing<A>::request_parts(const Content& content) {
    for (std::size_t i = 0; i < std::tuple_size_v<Parts>; ++i)
        // NOLINTNEXTLINE(performance-no-int-to-ptr): never read, only requested
        __builtin_prefetch(reinterpret_cast<const void*>(content.words_[i]), 1);
}

/// Moves the reader on, if the writer has dropped the value at its position.
template <class A>
void BasicCellRing<A>::catch_up() {
    const std::uint64_t word = cells_[reader_.cell].word.load(std::memory_order_acquire);
    const std::int64_t ahead = distance(word, reader_.position);
    if (ahead == 0 && !is_unread(word)) {
        step(reader_);
    } else if (ahead > 0) {
        // The word is of the newest value of this cell. published_ may be one behind.
        const std::uint64_t oldest = std::max(reader_.position + static_cast<std::uint64_t>(ahead) - depth(),
                                              published_.load(std::memory_order_acquire) - depth());
        reader_.cell =
            static_cast<std::uint32_t>(cell_at(reader_, static_cast<long>(oldest - reader_.position)));
        reader_.position = oldest;
    }
    set_taken(reader_.position);
}

/// Each failed attempt means that the writer has dropped values in the meantime.
template <class A>
bool BasicCellRing<A>::take_overtaken() {
    constexpr int max_attempts = 64;
    for (int i = 0; i < max_attempts; ++i) {
        catch_up();
        // catch_up() has seen that this value was published.
        const std::uint64_t word = cells_[reader_.cell].word.load(std::memory_order_relaxed);
        if (is_before_reader(word)) return false;
        if (try_take(word)) return true;
    }
    return false;
}

template <class A>
bool BasicCellRing<A>::peek() {
    if (!take()) return false;
    has_peeked_ = true;
    set_taken(reader_.position - 1);
    return true;
}

/// Returns false if the peeked value is no longer one of the newest `depth`.
template <class A>
bool BasicCellRing<A>::take_peeked() {
    has_peeked_ = false;
    set_taken(reader_.position);
    return published_.load(std::memory_order_acquire) < reader_.position + depth();
}

template <class A>
template <class Store>
void BasicCellRing<A>::settle(const Store& store) {
    catch_up();
    if (taken_.is_short()) store(reader_.value, taken_);
    taken_.head_ = 0;
    for (std::uint32_t i = 0; i < cell_count_; ++i) {
        const Content content = load_content(cells_[i]);
        if (!content.is_short()) continue;
        if (const auto place = place_of(i)) store(*place, content);
        cells_[i].head.store(0, std::memory_order_relaxed);
    }
}

/// Returns the index of the value that a cell's bytes belong to. Taking a value leaves it to the reader, and the value taken
/// before in the cell: see readers(). Returns nothing for the value taken last, whose bytes the reader has.
template <class A>
std::optional<std::uint32_t> BasicCellRing<A>::place_of(std::uint32_t cell) const {
    const std::uint64_t word = cells_[cell].word.load(std::memory_order_acquire),
                        behind = cells_[cell_behind(cell)].word.load(std::memory_order_acquire);
    if (is_unread(word)) return index(word);
    const bool was_behind_taken =
        behind >> position_shift == (word >> position_shift) + 1 && !is_unread(behind);
    return was_behind_taken ? std::optional(index(behind)) : std::nullopt;
}

template <class A>
std::size_t BasicCellRing<A>::cell_at(const End& end, long offset) const {
    const long size = static_cast<long>(cell_count_);
    return static_cast<std::size_t>(((static_cast<long>(end.cell) + offset) % size + size) % size);
}

// publish() exchanges the writer's value for the one in the cell, so the next value to write is the one of the cell
// before. take() does the same in the other direction.
template <class A>
std::uint32_t BasicCellRing<A>::writers(long offset) const {
    return offset == 0 ? writer_.value
                       : index(cells_[cell_at(writer_, offset > 0 ? offset - 1 : offset)].word.load(
                             std::memory_order_acquire));
}

template <class A>
std::uint32_t BasicCellRing<A>::readers(long offset) const {
    return offset == -1 ? reader_.value
                        : index(cells_[cell_at(reader_, offset < 0 ? offset + 1 : offset)].word.load(
                              std::memory_order_acquire));
}

template <class A>
void BasicCellRing<A>::unpublish() {
    step_back(writer_);
    Word& word = cells_[writer_.cell].word;
    const std::uint64_t before = word.load(std::memory_order_acquire);
    word.store(pack(writer_.position - cell_count_, false, writer_.value), std::memory_order_release);
    writer_.value = index(before);
    published_.store(writer_.position, std::memory_order_release);
}

template <class A>
void BasicCellRing<A>::untake() {
    step_back(reader_);
    Word& word = cells_[reader_.cell].word;
    const std::uint64_t before = word.load(std::memory_order_acquire);
    word.store(pack(reader_.position, true, reader_.value), std::memory_order_release);
    reader_.value = index(before);
    set_taken(reader_.position);
}

} // namespace tandem::rt
