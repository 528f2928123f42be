// SPDX-License-Identifier: Apache-2.0
// Ours, for hosts and bridges.
#ifndef DATAPATHWARMUP_H_
#define DATAPATHWARMUP_H_

/// A connection, or an input port, that passes values on and knows warm-ups: an opros_any whose isWarmUp() says so is pushed
/// through it as far as nobody notices, so that the code and the data of that way are in the caches when the component
/// pushes. Others are not shown one.
class DataPathWarmUp {
  public:
    virtual ~DataPathWarmUp() {}
};

#endif
