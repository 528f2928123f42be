// SPDX-License-Identifier: Apache-2.0
// Ours, for hosts and bridges.
#ifndef DATAPATHWARMUP_H_
#define DATAPATHWARMUP_H_

/// Implemented by connections and input ports that pass values on and support warm-ups. A warm-up is an opros_any
/// whose isWarmUp() returns true. It takes the path of a value as far as it has no visible effect, so that the code
/// and data of that path are in the caches when the component pushes. Connections and ports without this class get no
/// warm-ups.
class DataPathWarmUp {
  public:
    virtual ~DataPathWarmUp() {}
};

#endif
