// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/engine/rtm_api.hpp"

namespace tandem::interceptor {

/// Mirrors an InPort of the shared RTC: the OutPort that is connected with it, of a data type known only at run time. No
/// data pass through this object: the connector's buffer is a LinkBuffer, through which the RTC's InPort reads the ring of
/// the link.
class MirrorInPort final : public RTC::OutPortBase {
  public:
    /// `data_type` is the IDL type of the RTC's port, so that the connection's type check succeeds.
    MirrorInPort(const char* name, const char* data_type) : RTC::OutPortBase(name, data_type) {
        addProperty("dataport.marshaling_types", "cdr");
    }
    bool write() override { return false; }
};

} // namespace tandem::interceptor
