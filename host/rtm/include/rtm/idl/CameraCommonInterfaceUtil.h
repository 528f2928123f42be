// SPDX-License-Identifier: Apache-2.0
// Its path in OpenRTM-aist 2.x.
#ifndef RTM_IDL_CAMERACOMMONINTERFACEUTIL_H
#define RTM_IDL_CAMERACOMMONINTERFACEUTIL_H
#include <rtm/ext/CameraCommonInterfaceUtil.h>
#endif
