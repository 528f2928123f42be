// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_DATAPORTSTATUS_H
#define RTC_DATAPORTSTATUS_H
#include <cstdint>
#include <vector>

namespace RTC {

struct DataPortStatusCode {
    enum Enum : std::uint8_t {
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
};

/// The result of sending or receiving a message. It is a scoped enumeration in 2.x, and a class that contains an
/// `Enum` in 1.x. This class can be used as either. BUFFER_... refers to the buffer on this side; SEND_... and
/// RECV_... refer to the peer.
class DataPortStatus {
  public:
    static const DataPortStatus PORT_OK, PORT_ERROR, BUFFER_ERROR, BUFFER_FULL, BUFFER_EMPTY, BUFFER_TIMEOUT,
        SEND_FULL, SEND_TIMEOUT, RECV_EMPTY, RECV_TIMEOUT, INVALID_ARGS, PRECONDITION_NOT_MET,
        CONNECTION_LOST, UNKNOWN_ERROR;
    using Enum = DataPortStatusCode::Enum;
    DataPortStatus() = default;
    constexpr DataPortStatus(Enum code) : m_code(code) {}
    constexpr explicit DataPortStatus(int code) : m_code(static_cast<Enum>(code)) {}
    constexpr operator Enum() const { return m_code; }
    static const char* toString(DataPortStatus status);

  private:
    Enum m_code;
};
using DataPortStatusList = std::vector<DataPortStatus>;

const char* toString(DataPortStatus status);

// Inline variables are C++17. Both compilers accept them in C++14 with this warning, which is disabled here.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wc++17-extensions"
#define TANDEM_DATAPORT_STATUS(NAME)                                                                         \
    inline constexpr DataPortStatus DataPortStatus::NAME{DataPortStatusCode::NAME};
TANDEM_DATAPORT_STATUS(PORT_OK)
TANDEM_DATAPORT_STATUS(PORT_ERROR)
TANDEM_DATAPORT_STATUS(BUFFER_ERROR)
TANDEM_DATAPORT_STATUS(BUFFER_FULL)
TANDEM_DATAPORT_STATUS(BUFFER_EMPTY)
TANDEM_DATAPORT_STATUS(BUFFER_TIMEOUT)
TANDEM_DATAPORT_STATUS(SEND_FULL)
TANDEM_DATAPORT_STATUS(SEND_TIMEOUT)
TANDEM_DATAPORT_STATUS(RECV_EMPTY)
TANDEM_DATAPORT_STATUS(RECV_TIMEOUT)
TANDEM_DATAPORT_STATUS(INVALID_ARGS)
TANDEM_DATAPORT_STATUS(PRECONDITION_NOT_MET)
TANDEM_DATAPORT_STATUS(CONNECTION_LOST)
TANDEM_DATAPORT_STATUS(UNKNOWN_ERROR)
#undef TANDEM_DATAPORT_STATUS
#pragma GCC diagnostic pop

} // namespace RTC

/// 1.x: the codes as names of a class, and `ReturnCode` as their type.
#define DATAPORTSTATUS_ENUM                                                                                  \
    typedef ::RTC::DataPortStatus::Enum ReturnCode;                                                          \
    static const ReturnCode PORT_OK = ::RTC::DataPortStatusCode::PORT_OK;                                    \
    static const ReturnCode PORT_ERROR = ::RTC::DataPortStatusCode::PORT_ERROR;                              \
    static const ReturnCode BUFFER_FULL = ::RTC::DataPortStatusCode::BUFFER_FULL;                            \
    static const ReturnCode BUFFER_EMPTY = ::RTC::DataPortStatusCode::BUFFER_EMPTY;                          \
    static const ReturnCode BUFFER_TIMEOUT = ::RTC::DataPortStatusCode::BUFFER_TIMEOUT;                      \
    static const ReturnCode SEND_FULL = ::RTC::DataPortStatusCode::SEND_FULL;                                \
    static const ReturnCode SEND_TIMEOUT = ::RTC::DataPortStatusCode::SEND_TIMEOUT;                          \
    static const ReturnCode RECV_EMPTY = ::RTC::DataPortStatusCode::RECV_EMPTY;                              \
    static const ReturnCode RECV_TIMEOUT = ::RTC::DataPortStatusCode::RECV_TIMEOUT;                          \
    static const ReturnCode INVALID_ARGS = ::RTC::DataPortStatusCode::INVALID_ARGS;                          \
    static const ReturnCode PRECONDITION_NOT_MET = ::RTC::DataPortStatusCode::PRECONDITION_NOT_MET;          \
    static const ReturnCode CONNECTION_LOST = ::RTC::DataPortStatusCode::CONNECTION_LOST;                    \
    static const ReturnCode UNKNOWN_ERROR = ::RTC::DataPortStatusCode::UNKNOWN_ERROR
#endif
