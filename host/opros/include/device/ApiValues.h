// SPDX-License-Identifier: Apache-2.0
// A number, a string or a list of them, with the status of the call that produced it.
#ifndef DEVICE_APIVALUES_H_
#define DEVICE_APIVALUES_H_

#include "ApiMembers.h"

#include <ReturnType.h>

#include <cstdint>
#include <string>
#include <vector>

typedef char char_t;
typedef float float32_t;
typedef double float64_t;

namespace OPRoS {

/// Defines a class NAME with `status` (OPROS_SUCCESS unless set), `data` of the type, and a conversion from the type.

#define OPROS_API_VALUE(name, type)                                                                          \
    class name {                                                                                             \
      public:                                                                                                \
        ReturnType status;                                                                                   \
        type data;                                                                                           \
        name() : status(OPROS_SUCCESS), data() {}                                                            \
        name(type value) : status(OPROS_SUCCESS), data(value) {}                                             \
        OPROS_API_MEMBERS(status, data)                                                                      \
    };                                                                                                       \
    OPROS_API_TYPE_NAME(name)

OPROS_API_VALUE(Bool, bool)
OPROS_API_VALUE(Char, char_t)
OPROS_API_VALUE(Int8, std::int8_t)
OPROS_API_VALUE(UInt8, std::uint8_t)
OPROS_API_VALUE(Int16, std::int16_t)
OPROS_API_VALUE(UInt16, std::uint16_t)
OPROS_API_VALUE(Int32, std::int32_t)
OPROS_API_VALUE(UInt32, std::uint32_t)
OPROS_API_VALUE(Int64, std::int64_t)
OPROS_API_VALUE(UInt64, std::uint64_t)
OPROS_API_VALUE(Float32, float32_t)
OPROS_API_VALUE(Float64, float64_t)
OPROS_API_VALUE(String, std::string)
OPROS_API_VALUE(BoolArray, std::vector<bool>)
OPROS_API_VALUE(CharArray, std::vector<char_t>)
OPROS_API_VALUE(Int8Array, std::vector<std::int8_t>)
OPROS_API_VALUE(UInt8Array, std::vector<std::uint8_t>)
OPROS_API_VALUE(Int16Array, std::vector<std::int16_t>)
OPROS_API_VALUE(UInt16Array, std::vector<std::uint16_t>)
OPROS_API_VALUE(Int32Array, std::vector<std::int32_t>)
OPROS_API_VALUE(UInt32Array, std::vector<std::uint32_t>)
OPROS_API_VALUE(Int64Array, std::vector<std::int64_t>)
OPROS_API_VALUE(UInt64Array, std::vector<std::uint64_t>)
OPROS_API_VALUE(Float32Array, std::vector<float32_t>)
OPROS_API_VALUE(Float64Array, std::vector<float64_t>)
OPROS_API_VALUE(StringArray, std::vector<std::string>)

} // namespace OPRoS

// For classes of devices, whose functions of OPRoS v2 call those of v1.1. Ours.
namespace opros {
namespace detail {

template <typename Number, typename Value>
std::vector<Number> numbers_in(const std::vector<Value>& values) {
    std::vector<Number> numbers;
    for (const Value& value : values) numbers.push_back(value.data);
    return numbers;
}

template <typename Device>
int get_numbers(Device& device, int (Device::*function)(std::vector<double>&),
                std::vector<OPRoS::Float64>& values) {
    std::vector<double> numbers;
    const int result = (device.*function)(numbers);
    values.assign(numbers.begin(), numbers.end());
    return result;
}

} // namespace detail
} // namespace opros

#endif
