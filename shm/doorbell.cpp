// SPDX-License-Identifier: Apache-2.0
#include "shm/doorbell.hpp"

namespace tandem::shm {

template class BasicDoorbell<RealAtomics>;

} // namespace tandem::shm
