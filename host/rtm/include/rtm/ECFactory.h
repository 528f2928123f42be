// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_ECFACTORY_H
#define RTC_ECFACTORY_H
#include <rtm/ExecutionContextBase.h>
#endif
