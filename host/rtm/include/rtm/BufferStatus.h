// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_BUFFERSTATUS_H
#define RTC_BUFFERSTATUS_H
#include <cstdint>

namespace RTC {

struct BufferStatusCode {
    enum Enum : std::uint8_t {
        OK = 0,
        BUFFER_ERROR,
        FULL,
        EMPTY,
        NOT_SUPPORTED,
        TIMEOUT,
        PRECONDITION_NOT_MET,
        // names of 1.x
        BUFFER_OK = OK,
        BUFFER_FULL = FULL,
        BUFFER_EMPTY = EMPTY
    };
};

/// The result of a buffer operation. It is a scoped enumeration in 2.x, and a class that contains an `Enum` in 1.x.
/// This class can be used as either.
class BufferStatus {
  public:
    static const BufferStatus OK, BUFFER_ERROR, FULL, EMPTY, NOT_SUPPORTED, TIMEOUT, PRECONDITION_NOT_MET;
    static const BufferStatus BUFFER_OK, BUFFER_FULL, BUFFER_EMPTY;
    using Enum = BufferStatusCode::Enum;
    BufferStatus() = default;
    constexpr BufferStatus(Enum code) : m_code(code) {}
    constexpr explicit BufferStatus(int code) : m_code(static_cast<Enum>(code)) {}
    constexpr operator Enum() const { return m_code; }
    static const char* toString(BufferStatus status) {
        static const char* const names[] = {"BUFFER_OK",           "BUFFER_ERROR",  "BUFFER_FULL",
                                            "BUFFER_EMPTY",        "NOT_SUPPORTED", "TIMEOUT",
                                            "PRECONDITION_NOT_MET"};
        return status.m_code < sizeof names / sizeof *names ? names[status.m_code] : "";
    }

  private:
    Enum m_code;
};
inline const char* toString(BufferStatus status) { return BufferStatus::toString(status); }

// Inline variables are C++17. Both compilers accept them in C++14 with this warning, which is disabled here.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wc++17-extensions"
#define TANDEM_BUFFER_STATUS(NAME) inline constexpr BufferStatus BufferStatus::NAME{BufferStatusCode::NAME};
TANDEM_BUFFER_STATUS(OK)
TANDEM_BUFFER_STATUS(BUFFER_ERROR)
TANDEM_BUFFER_STATUS(FULL)
TANDEM_BUFFER_STATUS(EMPTY)
TANDEM_BUFFER_STATUS(NOT_SUPPORTED)
TANDEM_BUFFER_STATUS(TIMEOUT)
TANDEM_BUFFER_STATUS(PRECONDITION_NOT_MET)
TANDEM_BUFFER_STATUS(BUFFER_OK)
TANDEM_BUFFER_STATUS(BUFFER_FULL)
TANDEM_BUFFER_STATUS(BUFFER_EMPTY)
#undef TANDEM_BUFFER_STATUS
#pragma GCC diagnostic pop

} // namespace RTC

/// 1.x: the codes as names of a class, and `ReturnCode` as their type.
#define BUFFERSTATUS_ENUM                                                                                    \
    typedef ::RTC::BufferStatus::Enum ReturnCode;                                                            \
    static const ReturnCode BUFFER_OK = ::RTC::BufferStatusCode::OK;                                         \
    static const ReturnCode BUFFER_ERROR = ::RTC::BufferStatusCode::BUFFER_ERROR;                            \
    static const ReturnCode BUFFER_FULL = ::RTC::BufferStatusCode::FULL;                                     \
    static const ReturnCode BUFFER_EMPTY = ::RTC::BufferStatusCode::EMPTY;                                   \
    static const ReturnCode NOT_SUPPORTED = ::RTC::BufferStatusCode::NOT_SUPPORTED;                          \
    static const ReturnCode TIMEOUT = ::RTC::BufferStatusCode::TIMEOUT;                                      \
    static const ReturnCode PRECONDITION_NOT_MET = ::RTC::BufferStatusCode::PRECONDITION_NOT_MET
#endif
