// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OPRoSTypes.h>

namespace opros {

/// The values that an input port gives to its consumer. The consumer deletes them, which returns the object and the
/// value's storage to the pool. Therefore pop() allocates no memory once the usual number of values has been in use.
/// A value may outlive the pool, and another thread may delete it.
class ValuePool {
  public:
    ValuePool();
    ~ValuePool();
    ValuePool(const ValuePool&) = delete;
    ValuePool& operator=(const ValuePool&) = delete;

    /// Returns the content of `value`, for the caller to delete. Leaves `value` with the storage of a value that was
    /// given back, or empty. [one thread at a time]
    opros_any* lend(opros_any& value);

    struct Slots;

  private:
    Slots& slots_; ///< outlives the pool until the last value is given back
};

} // namespace opros
