// SPDX-License-Identifier: Apache-2.0
// Place of OpenRTM-aist 1.x.
#ifndef RTM_IDL_CAMERACOMMONINTERFACESKEL_H
#define RTM_IDL_CAMERACOMMONINTERFACESKEL_H
#include <rtm/ext/CameraCommonInterfaceSkel.h>
#endif
