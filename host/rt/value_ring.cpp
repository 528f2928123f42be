// SPDX-License-Identifier: Apache-2.0
#include "host/rt/value_ring.hpp"

namespace tandem::rt {

template class BasicCellRing<shm::RealAtomics>;

CellRing& rehearsal_ring() {
    thread_local CellRing ring(1);
    return ring;
}

} // namespace tandem::rt
