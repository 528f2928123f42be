// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tandem::interceptor::engine {

/// Signature of an IDL data type by its repository id, as RTC::InterfaceSignatures has it; empty when unknown. Ports of an
/// engine with extensions have registered theirs. For others the TypeCode is looked for among the symbols of the libraries
/// that are loaded, where omniidl has put it with its option -Wba, as RTCs have it. [any-thread]
std::string data_type_signature(const std::string& repository_id);

} // namespace tandem::interceptor::engine
