// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_DATAOUTPORT_H
#define RTC_DATAOUTPORT_H
#include <rtm/OutPort.h>
#endif
