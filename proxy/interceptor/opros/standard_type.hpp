// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace tandem::interceptor {

/// The repository id of RTM's standard data type whose members, with or without the leading time, are those of the
/// signature: `IDL:RTC/TimedDoubleSeq:1.0` for `ad`. Of several the first in the order of BasicDataType.idl,
/// ExtendedDataTypes.idl, InterfaceDataTypes.idl. Empty when there is none. Throws wire::SignatureError.
std::string standard_type(std::string_view signature);

} // namespace tandem::interceptor
