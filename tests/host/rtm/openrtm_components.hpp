// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <rtm/Manager.h>

/// Registers the component types of openrtm_components.cpp.
void register_openrtm_components(RTC::Manager& manager);
