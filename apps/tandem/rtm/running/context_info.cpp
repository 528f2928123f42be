// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/running/context_info.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <rtm/NVUtil.h>

namespace tandem::command {

ContextInfo::ContextInfo(RTC::ExecutionContext_ptr context) {
    try {
        RTC::ExecutionContextService_var service = RTC::ExecutionContextService::_narrow(context);
        if (!CORBA::is_nil(service.in())) profile_ = service->get_profile();
    } catch (const CORBA::SystemException&) {
        profile_ = nullptr;
    }
}

std::string ContextInfo::running_callback(const std::string& instance) const {
    return property("callback.component") == instance ? property("callback.name") : "";
}

std::string ContextInfo::describe_running_callback(const std::string& instance) const {
    const std::string callback = running_callback(instance);
    return callback.empty() ? ""
                            : fmt::format("{} has taken {} s so far", callback, property("callback.seconds"));
}

double ContextInfo::period_s() const {
    return profile_.operator->() && profile_->rate > 0 ? std::min(1 / profile_->rate, 1.0) : 0;
}

std::string ContextInfo::property(const char* name) const {
    return profile_.operator->() ? NVUtil::toString(profile_->properties, name) : "";
}

bool is_in_tandem_host(RTC::RTObject_ptr component) {
    RTC::ExecutionContextList_var own = component->get_owned_contexts();
    return own->length() > 0 && ContextInfo(own[0]).reports_callbacks();
}

} // namespace tandem::command
