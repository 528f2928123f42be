// SPDX-License-Identifier: Apache-2.0
#ifndef BASIC_TYPES_H_
#define BASIC_TYPES_H_

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace opros {

typedef unsigned char byte;
typedef unsigned int uint;
typedef unsigned long ulong;
typedef unsigned char uint8;
typedef char int8;
typedef unsigned short uint16;
typedef short int16;
typedef unsigned int uint32;
typedef int int32;
typedef unsigned long long uint64;
typedef long long int64;
typedef float float32;
typedef double float64;
typedef wchar_t WideChar;
typedef std::vector<std::string> StringList;
typedef std::map<std::string, std::string> StringMap;

} // namespace opros

#ifndef TRUE
#define TRUE 1
#endif
#ifndef FALSE
#define FALSE 0
#endif
#define portable_dynamic_cast(Type, obj) static_cast<Type>(obj)

#endif
