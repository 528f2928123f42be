// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/factory.hpp"

#include "proxy/interceptor/engine/capabilities.hpp"
#include "proxy/interceptor/engine/manager.hpp"
#include "proxy/interceptor/interceptor_comp.hpp"

#include <tandem_version.hpp>

namespace tandem::interceptor {
namespace {

/// The profile of a component type, as a manager wants it.
coil::Properties profile_of(const char* type, const char* description) {
    coil::Properties profile;
    const std::pair<const char*, const char*> values[] = {
        {"implementation_id", type},   {"type_name", type},           {"description", description},
        {"version", tandem::version},  {"vendor", "Tandem"},          {"category", "proxy"},
        {"activity_type", "PERIODIC"}, {"kind", "DataFlowComponent"}, {"max_instance", "0"},
        {"language", "C++"},           {"lang_type", "compile"}};
    for (const auto& [key, value] : values) profile.setProperty(key, value);
    return profile;
}

} // namespace

void register_factories(RTC::Manager& manager) {
    coil::Properties own = profile_of("InterceptorComp", "the RTM side of Tandem's proxy");
    // It executes nothing: a context that ticks would only wake its thread in each period.
    own.setProperty("execution_contexts", engine::idle_context);
    manager.registerFactory(own, RTC::Create<InterceptorComp>, RTC::Delete<InterceptorComp>);
    coil::Properties shown = profile_of(OprosRtc::implementation_id, "shows an OPRoS component");
    // Calls may still use it when its manager deletes it.
    manager.registerFactory(shown, RTC::Create<OprosRtc>, engine::release_component);
}

} // namespace tandem::interceptor
