// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"
#include "proxy/wire/signature_match.hpp"

#include <OPRoSTypes.h>

#include <string>

namespace tandem::adaptor {

/// The result of check_type().
struct TypeCheck {
    wire::SignatureMatch match = wire::SignatureMatch::mismatch; ///< from the OPRoS type to the peer's
    std::string error; ///< empty, or one line with both types and signatures
};

/// Compares the type of an OPRoS data port, of which `sample` is a value, with the signature of the peer's
/// port. Accepted are equal signatures, and add_time: the peer's message begins with RTM's time and the OPRoS
/// value does not. Throws nothing; the error is in the result.
TypeCheck check_type(const opros_any& sample, const link::Port& peer);

/// The signature of the type that the sample holds, in canonical form. Throws archive_type_exception when the
/// type cannot be serialized.
std::string value_signature(const opros_any& sample);

} // namespace tandem::adaptor
