// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

namespace tandem::bench {

/// How much of the machine other processes have used since its construction: the busy time of all cores without
/// that of this process and of its children that have ended. Its resolution is the kernel's tick, 10 ms.
class MachineLoad {
  public:
    MachineLoad();
    /// 0 to 1 of the time of all cores.
    double foreign_cpu_share() const;

  private:
    struct Reading {
        double busy, total, own; // seconds of CPU time since boot; own: of this process and its children
    };
    static Reading read();
    Reading start_;
};

} // namespace tandem::bench
