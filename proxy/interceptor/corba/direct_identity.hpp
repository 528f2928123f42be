// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/corba/generic_servant.hpp"

#include <inProcessIdentity.h>
#include <localIdentity.h>

namespace tandem::interceptor {

/// The identity of an object reference of this process to a GenericServant: what omniORB looks at to learn how the reference
/// is called. omniORB's own for a servant without a compiled skeleton looks for the object in a table and sends arguments and
/// results through a stream between two encodings; this one calls the servant, as long as its object is active. Everything
/// that is no call of an operation goes omniORB's way. Its functions are called with the ORB's internal lock.
class DirectIdentity final : public omniInProcessIdentity {
  public:
    /// Gives it to the reference that this call uses, unless it has one. Without the ORB's internal lock. [any-thread]
    static void give(omniCallDescriptor& call, omniLocalIdentity& object, GenericServant& servant);

    void dispatch(omniCallDescriptor& call) override;

  private:
    DirectIdentity(omniLocalIdentity& object, GenericServant& servant);
    ~DirectIdentity() override;

    omniLocalIdentity& object_; ///< kept; says whether the object is active
    GenericServant& servant_;   ///< valid while it is
};

} // namespace tandem::interceptor
