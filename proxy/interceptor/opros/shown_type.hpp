// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"

#include <string>

namespace tandem::interceptor {

/// Returns the repository id of the RTM data type that shows a data or event port of an OPRoS component. Order of choice:
/// the IDL structure that the port's type names; the first of RTM's standard types whose members are those of the port's
/// signature (`IDL:RTC/TimedDoubleSeq:1.0` for `ad`); the first such known type with a leading time. The content of an
/// event may be a structure or its members. Throws std::runtime_error, one line, if none fits.
std::string shown_type(const link::Port& port);

} // namespace tandem::interceptor
