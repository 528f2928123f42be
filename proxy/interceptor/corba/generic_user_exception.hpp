// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/operation.hpp"

#include <omniORB4/CORBA.h>

#include <cstddef>
#include <string>
#include <vector>

namespace tandem::interceptor {

/// A user exception of any type, without compiled code for it: thrown by a servant, the ORB sends it to the caller,
/// in this process or another one, who gets the exception of that repository id.
class GenericUserException final : public CORBA::UserException {
  public:
    /// `fields` in CDR. Throws CORBA::MARSHAL when they are no message of the type.
    GenericUserException(const wire::ExceptionType& type, std::vector<std::byte> fields);

    void _raise() const override { throw *this; }

  private:
    // What omniidl generates for each exception.
    CORBA::Exception* _NP_duplicate() const override { return new GenericUserException(*this); }
    const char* _NP_typeId() const override { return "Exception/UserException"; }
    const char* _NP_repoId(int* size) const override;
    void _NP_marshal(cdrStream& stream) const override;

    std::string id_;
    wire::Type type_;
    std::vector<std::byte> fields_;
};

} // namespace tandem::interceptor
