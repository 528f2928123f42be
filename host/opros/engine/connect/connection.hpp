// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::engine {

/// A connection between two ports, which exists as long as this object: the constructor connects the ports, the
/// destructor disconnects them. [main-thread] both, and not while a component uses the ports. Both components
/// must outlive it.
class Connection {
  public:
    virtual ~Connection() = default;
};

} // namespace tandem::engine
