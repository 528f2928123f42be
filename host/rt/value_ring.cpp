// SPDX-License-Identifier: Apache-2.0
#include "host/rt/value_ring.hpp"

#include <memory>

namespace tandem::rt {

template class BasicCellRing<shm::RealAtomics>;

CellRing& rehearsal_ring() {
    // A pointer, because programs that load the library at run time have little memory for static thread storage.
    thread_local const auto ring = std::make_unique<CellRing>(1);
    return *ring;
}

} // namespace tandem::rt
