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

/// The bytes are not a value of the type, or the JSON is not. what() names the member, as in `TimedLong.tm.sec`.
class DataConversionError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Converts samples of data ports between CDR and JSON, for types that are known at run time only, by their
/// TypeCode. Works on CORBA's DynAny. Structs are JSON objects; sequences and arrays are lists, those of octets a
/// string of hexadecimal digits; enums are their names; wide characters are numbers. Types any, union and object
/// reference are not supported. Not thread-safe.
class CdrJsonConverter {
  public:
    /// The ORB must outlive the converter.
    explicit CdrJsonConverter(CORBA::ORB_ptr orb);

    /// One sample as JSON. Throws DataConversionError.
    Json to_json(CORBA::TypeCode_ptr type, const RTC::ByteData& bytes) const;

    /// One sample from JSON, in the byte order that the port's connection has agreed on. Members that are left out
    /// are zero or empty. A value that is no object stands for {"data": value} if the type has a member `data`.
    /// Throws DataConversionError.
    RTC::ByteData to_cdr(CORBA::TypeCode_ptr type, const Json& value, bool little_endian) const;

  private:
    DynamicAny::DynAnyFactory_var factory_;
};

} // namespace tandem::command
