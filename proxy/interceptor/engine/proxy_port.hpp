// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/log/log.hpp"
#include "proxy/interceptor/engine/rtm_api.hpp"

#ifdef TANDEM_RTM_PUBLIC_API

#include <algorithm>
#endif

#include <string>
#include <vector>

namespace tandem::interceptor::engine {

#ifdef TANDEM_RTM_PUBLIC_API
/// Wraps bytes for a connector, which sends only streams.
class BytesStream final : public RTC::ByteDataStreamBase {
  public:
    explicit BytesStream(RTC::ByteData& bytes) : bytes_(bytes) {}
    void writeData(const unsigned char* buffer, unsigned long length) override {
        bytes_.setDataLength(length);
        std::copy(buffer, buffer + length, bytes_.getBuffer());
    }
    void readData(unsigned char* buffer, unsigned long length) const override {
        const auto* from = bytes_.getBuffer();
        std::copy(from, from + std::min(length, bytes_.getDataLength()), buffer);
    }
    unsigned long getDataLength() const override { return bytes_.getDataLength(); }

  private:
    RTC::ByteData& bytes_;
};
#endif

/// Returns why the last connection of the port was refused, in one line.
inline std::string connect_error([[maybe_unused]] const RTC::PortBase& port) {
#ifdef TANDEM_RTM_PUBLIC_API
    return "one of the two has refused it; the log of the RTM manager says why";
#else
    return port.connectError();
#endif
}

/// Sends little-endian bytes through a connector, like OutPortConnector::write().
inline RTC::DataPortStatus write_bytes(RTC::OutPortConnector& connector, RTC::ByteData& bytes) {
#ifdef TANDEM_RTM_PUBLIC_API
    BytesStream stream(bytes);
    return connector.write(&stream);
#else
    return connector.write(bytes);
#endif
}

/// A data port of the proxy. `Base` is RTC::InPortBase or RTC::OutPortBase.
template <class Base>
class ProxyPort : public Base {
  protected:
    using Base::Base;

    /// Returns `code`, and reports the reason, in one line.
    RTC::ReturnCode_t refuse_connection(RTC::ReturnCode_t code, const std::string& reason) {
#ifdef TANDEM_RTM_PUBLIC_API
        log::error("{}", reason);
        return code;
#else
        return this->refuse(code, reason);
#endif
    }

    /// Ends connections whose peers are gone. Call it without the port's mutexes.
    void end_lost_connections(const std::vector<std::string>& ids) {
#ifdef TANDEM_RTM_PUBLIC_API
        for (const auto& id : ids)
            this->disconnect(id.c_str()); // also asks the peer, within the ORB's time limit
#else
        this->dropLostConnections(ids);
#endif
    }
};

} // namespace tandem::interceptor::engine
