// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_BASICDATATYPEUTIL_H
#define RTC_BASICDATATYPEUTIL_H
#include <rtm/DataTypeUtil.h>
#include <rtm/idl/BasicDataTypeSkel.h>
#endif
