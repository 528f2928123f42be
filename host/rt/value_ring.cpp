// SPDX-License-Identifier: Apache-2.0
#include "host/rt/value_ring.hpp"

#include <algorithm>

namespace tandem::rt {

// The first values have the positions depth, depth + 1 ... The words of the cells have those of one round before.
CellRing::CellRing(std::size_t depth)
    : cells_(depth), writer_{depth, 0, static_cast<std::uint32_t>(depth)},
      published_(depth), reader_{depth, 0, static_cast<std::uint32_t>(depth + 1)}, taken_(depth) {
    for (std::uint32_t i = 0; i < depth; ++i)
        cells_[i].word.store(pack(i, false, i), std::memory_order_relaxed);
}

std::size_t CellRing::size() const {
    const std::uint64_t taken = taken_.load(std::memory_order_relaxed),
                        published = published_.load(std::memory_order_acquire);
    return published > taken ? std::min<std::size_t>(published - taken, cells_.size()) : 0;
}

/// Moves the reader to the oldest value, if the writer has dropped the one at its position. Returns false if there is no
/// value.
bool CellRing::catch_up() {
    const std::uint64_t word = cells_[reader_.cell].word.load(std::memory_order_acquire);
    if (!is_unread(word)) return false;
    if (const std::int64_t ahead = distance(word, reader_.position); ahead != 0) {
        // The word is of the newest value of this cell. published_ may be one behind.
        const std::uint64_t oldest =
            std::max(reader_.position + static_cast<std::uint64_t>(ahead) + 1 - cells_.size(),
                     published_.load(std::memory_order_acquire) - cells_.size());
        reader_.cell =
            static_cast<std::uint32_t>(cell_at(reader_, static_cast<long>(oldest - reader_.position)));
        reader_.position = oldest;
        set_taken(reader_.position);
    }
    return true;
}

/// Each failed attempt means that the writer has dropped values meanwhile.
bool CellRing::take_overtaken() {
    constexpr int max_attempts = 64;
    for (int i = 0; i < max_attempts && catch_up(); ++i) {
        std::uint64_t word = cells_[reader_.cell].word.load(std::memory_order_acquire);
        if (is_unread(word) && try_take(word)) return true;
    }
    return false;
}

/// Returns false if the writer has dropped the peeked value: its cell has another one.
bool CellRing::take_peeked() {
    has_peeked_ = false;
    set_taken(reader_.position);
    const std::uint64_t word = cells_[cell_at(reader_, -1)].word.load(std::memory_order_acquire);
    return distance(word, reader_.position - 1) == 0;
}

bool CellRing::peek() {
    if (!take()) return false;
    has_peeked_ = true;
    set_taken(reader_.position - 1);
    return true;
}

std::size_t CellRing::cell_at(const End& end, long offset) const {
    const long size = static_cast<long>(cells_.size());
    return static_cast<std::size_t>(((static_cast<long>(end.cell) + offset) % size + size) % size);
}

// publish() exchanges the writer's value for the one in the cell, so the next value to write is the one of the cell
// before. take() does the same in the other direction.
std::uint32_t CellRing::writers(long offset) const {
    return offset == 0 ? writer_.value
                       : index(cells_[cell_at(writer_, offset > 0 ? offset - 1 : offset)].word.load());
}

std::uint32_t CellRing::readers(long offset) {
    catch_up();
    return offset == -1 ? reader_.value
                        : index(cells_[cell_at(reader_, offset < 0 ? offset + 1 : offset)].word.load());
}

void CellRing::unpublish() {
    step_back(writer_);
    const std::uint64_t before = cells_[writer_.cell].word.load();
    cells_[writer_.cell].word = pack(writer_.position - cells_.size(), false, writer_.value);
    writer_.value = index(before);
    published_ = writer_.position;
}

void CellRing::untake() {
    step_back(reader_);
    const std::uint64_t before = cells_[reader_.cell].word.load();
    cells_[reader_.cell].word = pack(reader_.position, true, reader_.value);
    reader_.value = index(before);
    set_taken(reader_.position);
}

} // namespace tandem::rt
