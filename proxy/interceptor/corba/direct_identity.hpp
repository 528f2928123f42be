// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/corba/generic_servant.hpp"

#include <inProcessIdentity.h>
#include <localIdentity.h>

namespace tandem::interceptor {

/// The identity of a GenericServant in an object reference of this process: omniORB uses it to decide how to call the
/// reference. omniORB's identity for a servant without a compiled skeleton looks up the object in a table, and sends
/// arguments and results through a stream between two encodings. This one calls the servant directly while its object is
/// active. All other uses of the reference go through omniORB. Its functions are called with the ORB's internal lock held.
class DirectIdentity final : public omniInProcessIdentity {
  public:
    /// Gives the identity to the reference that this call uses, unless it has one. Without the ORB's internal lock.
    /// [any-thread]
    static void give(omniCallDescriptor& call, omniLocalIdentity& object, GenericServant& servant);

    void dispatch(omniCallDescriptor& call) override;

  private:
    DirectIdentity(omniLocalIdentity& object, GenericServant& servant);
    ~DirectIdentity() override;

    omniLocalIdentity& object_; ///< kept; says whether the object is active
    GenericServant& servant_;   ///< valid while the object is active
};

} // namespace tandem::interceptor
