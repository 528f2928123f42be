// SPDX-License-Identifier: Apache-2.0
// Finds TypeCodes of data types that this program was not compiled with.
#pragma once
#include <omniORB4/CORBA.h>

#include <filesystem>
#include <string>

namespace tandem::command {

/// Loads the data types of a component's library. Its generated stubs contain their TypeCodes. Throws
/// std::runtime_error.
void load_type_library(const std::filesystem::path& library);

/// Returns the TypeCode for a repository id (`IDL:RTC/TimedLong:1.0`); nil if no library has it. All of OpenRTM's own
/// types are known.
CORBA::TypeCode_ptr find_type_code(const std::string& repository_id);

} // namespace tandem::command
