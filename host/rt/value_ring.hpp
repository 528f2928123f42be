// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/rt/cell_ring.hpp"
#include "host/rt/rehearsal.hpp"

#include <vector>

namespace tandem::rt {

using CellRing = BasicCellRing<shm::RealAtomics>;
extern template class BasicCellRing<shm::RealAtomics>;

/// Returns the ring that rehearsals of this thread use instead of a port's: they publish short values into it and take them, so
/// that this code is in the caches, too. It has a depth of 1. The next rehearsal drops what is left in it.
CellRing& rehearsal_ring();

/// Returns where this thread publishes and takes the short values of a ring: in a rehearsal, in rehearsal_ring().
inline CellRing& cells_for(CellRing& ring) { return rehearsing() ? rehearsal_ring() : ring; }

/// A queue of values between two threads: a CellRing with its values.
template <class Value>
class ValueRing : public CellRing {
  public:
    /// depth: 1 to max_depth. A full ring holds this many values. Each end owns one more, and the spare cell has one.
    explicit ValueRing(std::size_t depth) : CellRing(depth), values_(depth + 3) {}

    Value& at(std::uint32_t index) { return values_[index].value; }
    /// Returns the value that publish() appends. It holds an old value, whose memory can be reused. [writing thread]
    Value& next() { return at(writers()); }
    /// Returns the value that was taken or looked at last, if it is not a short one. [reading thread]
    Value& last() { return at(readers()); }

  private:
    struct alignas(line) Place {
        Value value{};
    };
    alignas(line) std::vector<Place> values_; // not in a line that an end writes
};

} // namespace tandem::rt
