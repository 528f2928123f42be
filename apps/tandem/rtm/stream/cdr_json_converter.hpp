// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <nlohmann/json.hpp>
#include <omniORB4/CORBA.h>
#include <omniORB4/dynAny.h>
#include <rtm/ByteData.h>

#include <stdexcept>
#include <string>

namespace tandem::command {

using Json = nlohmann::ordered_json; ///< members in the order of the IDL

/// The bytes or the JSON are not a value of the type. what() contains the member, as in `TimedLong.tm.sec`.
class DataConversionError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Converts samples of data ports between CDR and JSON, for types that are known only at run time by their TypeCode.
/// Uses CORBA's DynAny. Structs are JSON objects. Sequences and arrays are lists; those of octets are hexadecimal
/// strings. Enums are names; wide text is UTF-8. A union is {"case": LABEL, MEMBER: VALUE}. Does not support any, fixed,
/// long double and object reference. Not thread-safe.
class CdrJsonConverter {
  public:
    /// The ORB must outlive the converter.
    explicit CdrJsonConverter(CORBA::ORB_ptr orb);

    /// Returns a sample as JSON. Throws DataConversionError.
    Json to_json(CORBA::TypeCode_ptr type, const RTC::ByteData& bytes) const;

    /// Encodes a sample from JSON. `little_endian`: the byte order of the port's connection. Missing members are zero
    /// or empty. A value other than an object represents {"data": value} if the type has a member `data`. Throws
    /// DataConversionError.
    RTC::ByteData to_cdr(CORBA::TypeCode_ptr type, const Json& value, bool little_endian) const;

  private:
    DynamicAny::DynAnyFactory_var factory_;
};

} // namespace tandem::command
