// SPDX-License-Identifier: Apache-2.0
#include "host/rt/value_ring.hpp"

namespace tandem::rt {

template class BasicCellRing<shm::RealAtomics>;

} // namespace tandem::rt
