// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <rtm/Manager.h>

/// Registers the component types of ending_components.cpp.
void register_ending_components(RTC::Manager& manager);
