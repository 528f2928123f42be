// SPDX-License-Identifier: Apache-2.0
// TypeCodes of data types that this program was not compiled with.
#pragma once
#include <omniORB4/CORBA.h>

#include <filesystem>
#include <string>

namespace tandem::command {

/// Makes the data types of a component's library known: its generated stubs carry their TypeCodes. Throws
/// std::runtime_error.
void load_type_library(const std::filesystem::path& library);

/// TypeCode of a data type, by its repository id (`IDL:RTC/TimedLong:1.0`); nil when no library has it. All
/// of OpenRTM's own are known.
CORBA::TypeCode_ptr find_type_code(const std::string& repository_id);

} // namespace tandem::command
