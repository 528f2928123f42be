// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/segment/mapping.hpp"
#include "shm/wait/basic_doorbell.hpp"

#include <memory>

namespace tandem::shm {

extern template class BasicDoorbell<RealAtomics>;

/// One bell per side, however many ports: ready bits and a futex word, all in one line. Whoever has published
/// data rings a bit at the other side's bell, after the data, once per batch. That makes a system call only
/// if the owner sleeps, and does not even write while the owner looks at its rings itself (wait_for).
class Doorbell : public BasicDoorbell<RealAtomics> {
  public:
    Doorbell(std::shared_ptr<const Mapping> mapping, Side owner)
        : BasicDoorbell(mapping->half(owner).doorbell), mapping_(std::move(mapping)) {}

  private:
    std::shared_ptr<const Mapping> mapping_; // of the words
};

} // namespace tandem::shm
