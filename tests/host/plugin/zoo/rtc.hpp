// SPDX-License-Identifier: Apache-2.0
// A module with one component type, made by `make`.
#pragma once
#include <rtm/DataFlowComponentBase.h>
#include <rtm/Manager.h>

inline void register_type(RTC::Manager* manager, const char* name, RTC::RtcNewFunc make) {
    const char* const spec[] = {"implementation_id", name,         "type_name", name,
                                "description",       "of the zoo", ""};
    coil::Properties profile(spec);
    manager->registerFactory(profile, make, [](RTC::RTObject_impl* dying) { delete dying; });
}
