// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/requests/host_components.hpp"

#include "apps/tandem/rtm/running/local_managers.hpp"
#include "host/rtm/runtime/naming/remote_names.hpp"

#include <fmt/format.h>
#include <rtm/NVUtil.h>

namespace tandem::command {

const std::string& HostComponents::manager_of(std::uint32_t pid) {
    if (const auto known = managers_.find(pid); known != managers_.end()) return known->second;
    const auto found = find_local_managers(client_.orb(), static_cast<pid_t>(pid));
    if (found.empty())
        throw std::runtime_error(fmt::format("process {} is not an RTM host, or does not answer", pid));
    return managers_[pid] = found.front();
}

/// Forgets a manager after an error, because its process may be gone and the pid reused.
template <class Search>
RemoteComponent HostComponents::search(std::uint32_t pid, Search search) {
    try {
        return search(manager_of(pid));
    } catch (const std::runtime_error&) {
        managers_.erase(pid);
        throw;
    } catch (const CORBA::Exception& e) {
        managers_.erase(pid);
        throw_corba_error(fmt::format("the RTM host of process {}", pid), e);
    }
}

RemoteComponent HostComponents::find(std::uint32_t pid, const std::string& instance) {
    return search(pid, [&](const std::string& manager) {
        const std::string address = "rtcloc://" + manager + "/" + instance;
        return RemoteComponent{RTC::resolve_component(client_.orb(), address, {}, client_.timeout_ms()),
                               address, instance};
    });
}

RemoteComponent HostComponents::find_interceptor(std::uint32_t pid, const std::string& link) {
    return search(pid, [&](const std::string& address) -> RemoteComponent {
        RTM::Manager_var manager = RTC::resolve_manager(client_.orb(), address, client_.timeout_ms());
        RTC::RTCList_var components = manager->get_components();
        for (CORBA::ULong i = 0; i < components->length(); ++i) {
            RTC::ComponentProfile_var profile = components[i]->get_component_profile();
            if (std::string(profile->type_name) != "InterceptorComp" ||
                NVUtil::toString(profile->properties, "link") != link)
                continue;
            const std::string instance(profile->instance_name);
            return {RTC::RTObject::_duplicate(components[i]), "rtcloc://" + address + "/" + instance,
                    instance};
        }
        throw std::runtime_error(fmt::format("process {} has no InterceptorComp of link {}", pid, link));
    });
}

} // namespace tandem::command
