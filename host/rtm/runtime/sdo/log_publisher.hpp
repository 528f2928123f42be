// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/sdo/tool_services.hpp"
#include <coil/Logger.h>

namespace RTC {

/// Sends log lines to a tool (interface OpenRTM::Logger): those of the component and its ports, or of the loggers that
/// `logger.filter` names, up to `logger.log_level` (default: NORMAL) and the level of the process.
class LogPublisher : public ToolService, private coil::LogStreamBuffer {
  protected:
    void start(const coil::Properties& settings) override;
    void stop() override;

  private:
    void write(int level, const std::string& name, const std::string& date,
               const std::string& message) override;
    bool is_wanted(const std::string& name) const;

    CORBA::ULong max_level_ = 0;
    coil::vstring loggers_; // empty: the component and its ports
};

} // namespace RTC
