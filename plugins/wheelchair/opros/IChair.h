// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

/// The service of HWComp.
class IChair {
  public:
    virtual ~IChair() = default;
    // track, wheelbase, wheel radius [m], mass [kg], bus voltage [V]
    virtual std::vector<double> parameters() = 0;
    // forward, reverse, spin [m/s], lateral acceleration [m/s^2]
    virtual std::vector<double> limits() = 0;
    // Latched until the next start; true: the motors will stop in the next tick.
    virtual bool emergency_stop() = 0;
};
