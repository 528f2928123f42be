// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <rtm/Manager.h>

/// Registers a factory for `Rtc` under `name`, as the Init function that rtc-template writes does: a data-flow
/// component with a periodic execution context, with any number of instances.
template <class Rtc>
void register_rtc(RTC::Manager* manager, const char* name) {
    coil::Properties profile;
    for (const char* key : {"implementation_id", "type_name"}) profile.setProperty(key, name);
    for (const char* key : {"description", "category"}) profile.setProperty(key, "test");
    profile.setProperty("version", "1.0");
    profile.setProperty("vendor", "Tandem");
    profile.setProperty("activity_type", "PERIODIC");
    profile.setProperty("kind", "DataFlowComponent");
    profile.setProperty("max_instance", "0");
    profile.setProperty("language", "C++");
    profile.setProperty("lang_type", "compile");
    manager->registerFactory(profile, RTC::Create<Rtc>, RTC::Delete<Rtc>);
}
