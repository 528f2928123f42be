// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::engine {

/// A connection between two ports, which exists as long as this object: the constructor connects the ports, the
/// destructor disconnects them. [one thread at a time] Both components must outlive it.
class Connection {
  public:
    virtual ~Connection() = default;
    /// Disconnects the ports while the components run. Returns true if a call may still be under way in this object; the
    /// caller must then keep the object until the components have stopped.
    virtual bool disconnect() = 0;
};

} // namespace tandem::engine
