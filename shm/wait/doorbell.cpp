// SPDX-License-Identifier: Apache-2.0
#include "shm/wait/doorbell.hpp"

namespace tandem::shm {

template class BasicDoorbell<RealAtomics>;

} // namespace tandem::shm
