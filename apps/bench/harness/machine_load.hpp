// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

namespace tandem::bench {

/// Notices whether somebody else used the machine from its construction on: the busy time of all cores less
/// that of this process and of its children that have ended. Good to the kernel's tick, 10 ms.
class MachineLoad {
  public:
    MachineLoad();
    double foreign_cpu_share() const; ///< 0 to 1 of the machine's cores

  private:
    struct Reading {
        double busy, total, own; // seconds
    };
    static Reading read();
    Reading start_;
};

} // namespace tandem::bench
