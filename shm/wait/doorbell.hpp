// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/segment/mapping.hpp"
#include "shm/wait/basic_doorbell.hpp"

#include <memory>

namespace tandem::shm {

extern template class BasicDoorbell<RealAtomics>;

/// One doorbell per side, regardless of the number of ports: ready bits and a futex word in one cache line. A side that has
/// published data rings a bit of the peer's doorbell, once per batch. Ringing makes a system call only if the peer is asleep,
/// and does not even write while the peer polls its rings (wait_for()).
class Doorbell : public BasicDoorbell<RealAtomics> {
  public:
    Doorbell(std::shared_ptr<const Mapping> mapping, Side owner)
        : BasicDoorbell(mapping->side_header(owner).doorbell), mapping_(std::move(mapping)) {}

  private:
    std::shared_ptr<const Mapping> mapping_; // keeps the doorbell's words mapped
};

} // namespace tandem::shm
