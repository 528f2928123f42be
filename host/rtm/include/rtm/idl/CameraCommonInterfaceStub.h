// SPDX-License-Identifier: Apache-2.0
// Place of OpenRTM-aist 1.x.
#ifndef RTM_IDL_CAMERACOMMONINTERFACESTUB_H
#define RTM_IDL_CAMERACOMMONINTERFACESTUB_H
#include <rtm/ext/CameraCommonInterfaceStub.h>
#endif
