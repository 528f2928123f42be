// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"
#include "proxy/wire/conversion/conversion.hpp"
#include "proxy/wire/type.hpp"

#include <OPRoSTypes.h>

#include <optional>
#include <string>

namespace tandem::adaptor {

/// How values of an OPRoS data port cross, or why they cannot: the result of check_type().
struct TypeCheck {
    std::string
        error; ///< empty, or one line with both types, both signatures and the first member that differs
    bool value_has_time = false; ///< the OPRoS type begins with RTM's time, which the message header carries
    bool set_time = false;       ///< the time is that of the crossing, not the sender's
    std::optional<wire::Conversion> conversion{}; ///< of the rest; none if its bytes stay as they are
    std::optional<wire::Type>
        pictures{}; ///< the OPRoS type without its time, if it holds what picture_error() checks
};

/// Compares the type of an OPRoS data port, of which `sample` is a value, with the signature of the peer's port. Types
/// that fit need nothing, and RTM's leading time is added where the OPRoS type has none; `convert` says what else is to
/// be done (wire::parse_conversion_request), or `device`: as device_conversion() has it, which is also what happens
/// where nothing is asked for. `sends`: the OPRoS port is the sender. Throws nothing; the error is in the result.
TypeCheck check_type(const opros_any& sample, const link::Port& peer, bool sends,
                     const std::string& convert = "");

/// Why values of the sample's type cannot be written as bytes at all, and what to do; empty if they can.
std::string why_not_archived(const opros_any& sample);

/// What the type that the sample holds is, as its load() shows it. A union in `peer` is looked for: load() is shown
/// each discriminator and has to read that case's members. Throws std::exception when the type cannot cross.
wire::Type type_of(const opros_any& sample, const wire::Type& peer);

} // namespace tandem::adaptor
