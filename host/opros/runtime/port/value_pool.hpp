// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OPRoSTypes.h>

namespace opros {

/// The values that an input port gives to its consumer, who deletes them: deleting gives the object and the value's
/// storage back, so that no pop() allocates once as many values have been in use as usually are. A value may outlive
/// the pool and be deleted by another thread.
class ValuePool {
  public:
    ValuePool();
    ~ValuePool();
    ValuePool(const ValuePool&) = delete;
    ValuePool& operator=(const ValuePool&) = delete;

    /// [one thread at a time] The content of `value`, for the caller to delete. `value` is left with the storage of a
    /// value that was given back, or empty.
    opros_any* lend(opros_any& value);

    struct Slots;

  private:
    Slots& slots_; ///< deleted with the last value that is given back, if that comes after the pool's end
};

} // namespace opros
