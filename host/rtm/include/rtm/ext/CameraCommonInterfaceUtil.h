// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_CAMERACOMMONINTERFACEUTIL_H
#define RTC_CAMERACOMMONINTERFACEUTIL_H
#include <rtm/DataTypeUtil.h>
#include <rtm/ext/CameraCommonInterfaceSkel.h>
#endif
