// SPDX-License-Identifier: Apache-2.0
// The OpenRTM-aist version whose component API this is.
#ifndef RTM_VERSION_H
#define RTM_VERSION_H
#include <string>

static const char* const openrtm_name = "OpenRTM-aist-2.1.0";
static const char* const openrtm_version = "2.1.0";
static const char* const corba_name = "omniORB";
#endif
