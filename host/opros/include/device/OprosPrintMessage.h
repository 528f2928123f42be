// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_OPROSPRINTMESSAGE_H_
#define DEVICE_OPROSPRINTMESSAGE_H_

#include <cstdarg>
#include <cstdio>

#ifndef _snprintf
#define _snprintf snprintf // components know this name from Windows
#endif

/// Prints a component's message like printf() if _OPROS_DEBUG_, _DEBUG or NDEBUG is defined. Otherwise does nothing.
inline void PrintMessage(const char* format, ...) {
#if defined(_OPROS_DEBUG_) || defined(_DEBUG) || defined(NDEBUG)
    va_list arguments;
    va_start(arguments, format);
    std::vprintf(format, arguments);
    va_end(arguments);
#else
    static_cast<void>(format);
#endif
}

#endif
