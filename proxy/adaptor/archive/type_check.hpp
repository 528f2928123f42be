// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"
#include "proxy/wire/signature_match.hpp"
#include "proxy/wire/type.hpp"

#include <OPRoSTypes.h>

#include <string>

namespace tandem::adaptor {

/// The result of check_type().
struct TypeCheck {
    wire::SignatureMatch match = wire::SignatureMatch::mismatch; ///< from the OPRoS type to the peer's
    wire::Type type; ///< what the OPRoS type holds, with the names that it has
    std::string
        error; ///< empty, or one line with both types, both signatures and the first member that differs
};

/// Compares the type of an OPRoS data port, of which `sample` is a value, with the signature of the peer's
/// port. Accepted are signatures that fit, and add_time: the peer's message begins with RTM's time and the OPRoS
/// value does not. `sends`: the OPRoS port is the sender. Throws nothing; the error is in the result.
TypeCheck check_type(const opros_any& sample, const link::Port& peer, bool sends);

/// What the type that the sample holds is, as its load() shows it. A union in `peer` is looked for: load() is shown
/// each discriminator and has to read that case's members. Throws std::exception when the type cannot cross.
wire::Type type_of(const opros_any& sample, const wire::Type& peer);

} // namespace tandem::adaptor
