// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <rtm/InPortBase.h>
#include <rtm/OutPortBase.h>

namespace tandem::interceptor {

/// Ports of a type known at run time only. Data do not pass through them: their connectors' buffers are the
/// ring.
class RawInPort final : public RTC::InPortBase {
  public:
    RawInPort(const char* name, const char* data_type) : RTC::InPortBase(name, data_type) {
        addProperty("dataport.marshaling_types", "cdr");
    }
    bool read(std::string) override { return false; }
};

class RawOutPort final : public RTC::OutPortBase {
  public:
    RawOutPort(const char* name, const char* data_type) : RTC::OutPortBase(name, data_type) {
        addProperty("dataport.marshaling_types", "cdr");
    }
    bool write() override { return false; }
};

} // namespace tandem::interceptor
