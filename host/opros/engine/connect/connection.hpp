// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::engine {

/// A connection of the application: made by its constructor's caller, undone by its destructor.
class Connection {
  public:
    virtual ~Connection() = default;
};

} // namespace tandem::engine
