// SPDX-License-Identifier: Apache-2.0
#ifndef RTM_TIMESTAMP_H
#define RTM_TIMESTAMP_H
#include <chrono>
#include <rtm/ConnectorListener.h>

/// Sets data.tm to the system clock's time.
template <class DataType>
void setTimestamp(DataType& data) {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    const auto sec = std::chrono::duration_cast<std::chrono::seconds>(now);
    data.tm.sec = static_cast<decltype(data.tm.sec)>(sec.count());
    data.tm.nsec = static_cast<decltype(data.tm.nsec)>(
        std::chrono::duration_cast<std::chrono::nanoseconds>(now - sec).count());
}

namespace RTC {

// Calls setTimestamp() for types with a member tm, does nothing for others. Pass 0, which prefers the first overload.
template <class DataType>
auto stampIfPossible(DataType& data, int) -> decltype(data.tm.nsec, void()) {
    setTimestamp(data);
}
template <class DataType>
void stampIfPossible(DataType&, long) {}

/// The step at which a connector sets the time in its messages, from the property `timestamp_policy`.
enum class TimestampPolicy : std::uint8_t { none, on_write, on_send, on_received, on_read };
TimestampPolicy timestampPolicy(const coil::Properties& connector_properties);

/// A listener that sets the time. A component adds it itself.
template <class DataType>
class Timestamp : public ConnectorDataListenerT<DataType> {
    USE_CONNLISTENER_STATUS;

  public:
    explicit Timestamp(const char* ts_type) : m_tstype(ts_type) {}
    using ConnectorDataListenerT<DataType>::operator();
    ReturnCode operator()(ConnectorInfo& info, DataType& data) override {
        if (info.properties.getProperty("timestamp_policy") != m_tstype) return NO_CHANGE;
        stampIfPossible(data, 0);
        return DATA_CHANGED;
    }
    std::string m_tstype;
};

} // namespace RTC
#endif
