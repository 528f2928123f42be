// SPDX-License-Identifier: Apache-2.0
// Not compiled into anything: it must be refused.
#include <rtm/PortBase.h>

std::string reason(const RTC::PortBase& port) { return port.connectError(); }
