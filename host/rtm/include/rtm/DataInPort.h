// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_DATAINPORT_H
#define RTC_DATAINPORT_H
#include <rtm/InPort.h>
#endif
