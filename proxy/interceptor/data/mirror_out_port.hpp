// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/engine/rtm_api.hpp"

namespace tandem::interceptor {

/// Mirrors an OutPort of the shared RTC: the InPort that is connected with it, of a data type known only at run time. No
/// data pass through this object: the connector's buffer is a LinkBuffer, which writes to the ring of the link.
class MirrorOutPort final : public RTC::InPortBase {
  public:
    /// `data_type` is the IDL type of the RTC's port, so that the connection's type check succeeds.
    MirrorOutPort(const char* name, const char* data_type) : RTC::InPortBase(name, data_type) {
        addProperty("dataport.marshaling_types", "cdr");
        m_singlebuffer = false; // each connection has the LinkBuffer that its profile names
    }
    bool read(std::string) override { return false; }
};

} // namespace tandem::interceptor
