// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/type.hpp"

#include <omniORB4/CORBA.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace tandem::interceptor {

/// Where a GenericServant's calls go. Any ORB thread, or the calling component's own.
class CallTarget {
  public:
    virtual ~CallTarget() = default;
    /// Types of an operation; nullptr when there is no such operation. The result lives as long as the
    /// target.
    struct Operation {
        wire::Type arguments, result;
        std::string signature;
    };
    virtual const Operation* find(const char* operation) = 0;
    /// Arguments and results in CDR. A failure is thrown as a CORBA system exception.
    virtual std::vector<std::byte> call(const char* name, const Operation&,
                                        std::span<const std::byte> arguments) = 0;
};

/// A CORBA object of any interface, without a compiled skeleton: what arrives is moved by type signature
/// between the CORBA stream and CDR and handed to a CallTarget.
class GenericServant : public virtual PortableServer::ServantBase {
  public:
    /// `repository_id` is what a client's _narrow() is told; it may be a guess, _is_a() says yes to
    /// everything.
    GenericServant(std::string repository_id, CallTarget& target);

    _CORBA_Boolean _dispatch(omniCallHandle&) override;
    _CORBA_Boolean _is_a(const char* repository_id) override;

  private:
    void* _ptrToInterface(const char* repository_id) override;
    const char* _mostDerivedRepoId() override;

    std::string repository_id_;
    CallTarget& target_;
};

} // namespace tandem::interceptor
