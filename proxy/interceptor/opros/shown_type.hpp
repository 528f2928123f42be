// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"

#include <string>

namespace tandem::interceptor {

/// The RTM data type of a port that shows a data or event port of an OPRoS component.
struct ShownType {
    std::string repository_id;
    std::string signature; ///< of its messages, with a leading time if the type has one
};

/// Chooses the type. Order of choice: the IDL structure that the port's type names; the first of RTM's standard types
/// whose members are those of the port's signature (`IDL:RTC/TimedDoubleSeq:1.0` for `ad`); the first such known type with
/// a leading time. The content of an event may be a structure or its members. If the port's type names a structure of
/// module OPRoS, a type that only ports with the same members have replaces the known ones, which differ between hosts.
/// Throws std::runtime_error, one line, if none fits.
ShownType shown_type(const link::Port& port);

} // namespace tandem::interceptor
