// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_BUFFERSTATUS_H
#define RTC_BUFFERSTATUS_H
#include <cstdint>

namespace RTC {

enum class BufferStatus : std::uint8_t { OK = 0, BUFFER_ERROR, FULL, EMPTY, NOT_SUPPORTED, TIMEOUT, PRECONDITION_NOT_MET };

inline const char* toString(BufferStatus status) {
    static const char* const names[] = {"BUFFER_OK",     "BUFFER_ERROR", "BUFFER_FULL",         "BUFFER_EMPTY",
                                        "NOT_SUPPORTED", "TIMEOUT",      "PRECONDITION_NOT_MET"};
    return names[static_cast<std::uint8_t>(status)];
}

} // namespace RTC
#endif
