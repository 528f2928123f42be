// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tandem::interceptor::engine {

/// Returns the signature of an IDL data type by its repository id, in the form of RTC::InterfaceSignatures; empty if
/// unknown. Ports of an engine with extensions have registered their types. For others, looks for the TypeCode among the
/// symbols of the loaded libraries, where omniidl's option -Wba, which RTCs use, has put it. [any-thread]
std::string data_type_signature(const std::string& repository_id);

} // namespace tandem::interceptor::engine
