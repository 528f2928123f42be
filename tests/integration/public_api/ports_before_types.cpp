// SPDX-License-Identifier: Apache-2.0
// Not compiled into anything: it must be refused.
#include <rtm/DataFlowComponentBase.h>
#include <rtm/DataOutPort.h>
#include <rtm/idl/BasicDataTypeSkel.h>

void make(RTC::TimedDouble& value) { RTC::OutPort<RTC::TimedDouble> port("out", value); }
