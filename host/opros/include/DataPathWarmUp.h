// SPDX-License-Identifier: Apache-2.0
// Ours, for hosts and bridges.
#ifndef DATAPATHWARMUP_H_
#define DATAPATHWARMUP_H_

#include <OPRoSTypes.h>

/// Where a value passes on its way from an output data port: a connection, or an input port that passes values on.
class DataPathWarmUp {
  public:
    virtual ~DataPathWarmUp() {}
    /// Goes the way of a push as far as nobody notices, so that the code and the data of that way are in the caches when
    /// the component pushes. `sample` is a value of the port's type. [thread that pushes]
    virtual void warmUp(opros_any& sample) = 0;
};

#endif
