// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ReturnType.h>

#include <string>

namespace tandem::engine {

/// Returns the number as written in ReturnType.h (codes of device components are hexadecimal), followed by the name if it
/// has one: "400 (OPROS_CALLER_ERROR)". [any-thread]
std::string describe_code(ReturnType code);

} // namespace tandem::engine
