// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

/// Service of HWComp.
class IChair {
  public:
    virtual ~IChair() = default;
    virtual std::vector<double>
    parameters() = 0; // track, wheelbase, wheel radius [m], mass [kg], bus voltage [V]
    virtual std::vector<double> limits() = 0; // forward, reverse, spin [m/s], lateral acceleration [m/s^2]
    virtual bool emergency_stop() = 0;        // latched; true: the motors will stop in the next tick
};
