// SPDX-License-Identifier: Apache-2.0
// Macros by which component sources test for the version, the ORB and the system.
#ifndef CONFIG_RTC_H
#define CONFIG_RTC_H

#define ORB_IS_OMNIORB TRUE
#define RTM_OMNIORB_42
#define RTM_OS_LINUX TRUE
#define RTM_MAJOR_VERSION 2
#define RTM_MINOR_VERSION 1
#define RTM_REVISION_NUM 0
#define RTM_SHORT_VERSION "2.1"
#define RTM_VERSION "2.1.0"
#define RTM_PACKAGE "OpenRTM-aist"
#define RTM_PACKAGE_VERSION "2.1.0"
#endif
