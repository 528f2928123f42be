// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/port_table.hpp"
#include "proxy/wire/signature_match.hpp"

#include <OPRoSTypes.h>

#include <string>

namespace tandem::adaptor {

struct TypeCheck {
    wire::SignatureMatch match = wire::SignatureMatch::mismatch;
    std::string error; ///< empty, or one line with both types and signatures
};

/// Whether values of the sample's type may go to, or come from, the peer's port. The match is seen from
/// the OPRoS side: add_time means that the peer's message has RTM's time and the value has not.
TypeCheck check_type(const opros_any& sample, const link::Port& peer);

/// Signature of the type the sample holds. Throws archive_type_exception when it cannot be serialized.
std::string signature_of(const opros_any& sample);

} // namespace tandem::adaptor
