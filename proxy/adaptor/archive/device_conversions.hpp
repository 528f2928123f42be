// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/type.hpp"

#include <string>
#include <string_view>

namespace tandem::adaptor {

/// Returns the conversion between a data type of OPRoS's device API and its counterpart in RTM, as a request for
/// wire::Conversion; empty if there is none. `opros` is the OPRoS type without RTM's time, `rtm_type` a repository id. Names
/// OPRoS's fields by their position, because their archive keeps no names. docs/device_types.md lists the conversions.
std::string device_conversion(std::string_view opros_name, const wire::Type& opros, std::string_view rtm_type,
                              bool opros_sends);

} // namespace tandem::adaptor
