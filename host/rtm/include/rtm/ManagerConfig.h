// SPDX-License-Identifier: Apache-2.0
#ifndef RTM_MANAGERCONFIG_H
#define RTM_MANAGERCONFIG_H
#include <coil/Properties.h>
#include <string>
#include <vector>

namespace RTC {

/// Reads the settings that Manager::init() would read from the same command line.
class ManagerConfig {
  public:
    ManagerConfig() = default;
    ManagerConfig(int argc, char** argv);
    virtual ~ManagerConfig();
    void init(int argc, char** argv);
    /// Adds the default settings, those of rtc.conf, and those of the command line. Throws ManagerError if rtc.conf
    /// cannot be read.
    void configure(coil::Properties& prop);

  private:
    std::vector<std::string> m_arguments;
};

} // namespace RTC
#endif
