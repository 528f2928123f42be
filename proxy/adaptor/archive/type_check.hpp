// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"
#include "proxy/wire/conversion/conversion.hpp"
#include "proxy/wire/type.hpp"

#include <OPRoSTypes.h>

#include <optional>
#include <string>

namespace tandem::adaptor {

/// How values of an OPRoS data port cross, or why they cannot. The result of check_type().
struct TypeCheck {
    std::string
        error; ///< empty, or one line with both types, both signatures and the first member that differs
    bool value_has_time = false; ///< the OPRoS type begins with RTM's time, which the message header carries
    bool set_time = false;       ///< the time is that of the crossing, not the sender's
    std::optional<wire::Conversion> conversion{}; ///< of the rest; none if the bytes stay unchanged
    std::optional<wire::Type>
        pictures{}; ///< the OPRoS type without its time, if picture_error() must check it
};

/// Compares the type of an OPRoS data port, of which `sample` is a value, with the signature of the peer's port. RTM's
/// leading time is added if the OPRoS type has none. `convert` requests further conversions
/// (wire::parse_conversion_request); `device`, or an empty request, selects device_conversion(). `sends`: the OPRoS port is
/// the sender. Throws nothing; the error is in the result.
TypeCheck check_type(const opros_any& sample, const link::Port& peer, bool sends,
                     const std::string& convert = "");

/// Returns why values of the sample's type cannot be written as bytes at all, and what to do; empty if they can.
std::string why_not_archived(const opros_any& sample);

/// Returns the type that the sample contains, according to its load(). To find a union of `peer`, calls load() with each
/// discriminator, for which it must read the members of that case. Throws std::exception if the type cannot cross.
wire::Type type_of(const opros_any& sample, const wire::Type& peer);

} // namespace tandem::adaptor
