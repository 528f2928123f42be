// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_DATAPORTSTATUS_H
#define RTC_DATAPORTSTATUS_H
#include <cstdint>
#include <vector>

namespace RTC {

enum class DataPortStatus : std::uint8_t {
    PORT_OK = 0,
    PORT_ERROR,
    BUFFER_ERROR,
    BUFFER_FULL,
    BUFFER_EMPTY,
    BUFFER_TIMEOUT,
    SEND_FULL,
    SEND_TIMEOUT,
    RECV_EMPTY,
    RECV_TIMEOUT,
    INVALID_ARGS,
    PRECONDITION_NOT_MET,
    CONNECTION_LOST,
    UNKNOWN_ERROR
};
using DataPortStatusList = std::vector<DataPortStatus>;

const char* toString(DataPortStatus status);

} // namespace RTC
#endif
