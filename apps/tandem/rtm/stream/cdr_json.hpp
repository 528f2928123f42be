// SPDX-License-Identifier: Apache-2.0
// One message of a data port as JSON, by the TypeCode of its type.
#pragma once
#include <nlohmann/json.hpp>
#include <omniORB4/CORBA.h>
#include <rtm/ByteData.h>

#include <stdexcept>
#include <string>

namespace tandem::command {

using Json = nlohmann::ordered_json; ///< members in the order of the IDL

/// The bytes are not a message of that type, or the text is not a value of it; what() says where.
class DataConversionError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Structs become objects, sequences and arrays lists, enums their names, octet sequences a string of hex.
Json cdr_to_json(CORBA::TypeCode_ptr type, const RTC::ByteData& bytes);

/// The other way. A member that is left out is zero or empty; a plain value stands for {"data": value}.
RTC::ByteData json_to_cdr(CORBA::TypeCode_ptr type, const Json& value, bool little_endian);

/// `00 01 2a ...`
std::string hex_dump(const RTC::ByteData& bytes);

} // namespace tandem::command
