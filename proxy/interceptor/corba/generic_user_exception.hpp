// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/operation.hpp"

#include <omniORB4/CORBA.h>

#include <cstddef>
#include <string>
#include <vector>

namespace tandem::interceptor {

/// A user exception of any type without compiled code for it. If a servant throws it, the ORB passes it to the caller, in
/// this or another process, as the exception with that repository id.
class GenericUserException final : public CORBA::UserException {
  public:
    /// `fields` is in CDR. Throws CORBA::MARSHAL if `fields` is not a valid message of the type.
    GenericUserException(const wire::ExceptionType& type, std::vector<std::byte> fields);

    void _raise() const override { throw *this; }

  private:
    // The members that omniidl generates for each exception.
    CORBA::Exception* _NP_duplicate() const override { return new GenericUserException(*this); }
    const char* _NP_typeId() const override { return "Exception/UserException"; }
    const char* _NP_repoId(int* size) const override;
    void _NP_marshal(cdrStream& stream) const override;

    std::string id_;
    wire::Type type_;
    std::vector<std::byte> fields_;
};

} // namespace tandem::interceptor
