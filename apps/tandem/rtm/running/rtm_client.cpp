// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/running/rtm_client.hpp"
#include "apps/tandem/rtm/running/local_managers.hpp"
#include "host/rtm/runtime/manager/manager_options.hpp"
#include "host/rtm/runtime/naming/remote_names.hpp"
#include "host/rtm/runtime/network/tls.hpp"

#include <coil/stringutil.h>
#include <fmt/format.h>
#include <rtm/CORBA_RTCUtil.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>

namespace tandem::command {
namespace {

// Only a client, which does not listen. omniORB's log lines must not appear in the output. 64 MiB hold the largest
// images.
coil::vstring orb_arguments(unsigned long timeout_ms, const RtmClientOptions& options) {
    coil::vstring arguments{"tandem",
                            "-ORBclientCallTimeOutPeriod",
                            std::to_string(timeout_ms),
                            "-ORBgiopMaxMsgSize",
                            "67108864",
                            "-ORBtraceLevel",
                            "0"};
    for (const auto& argument : RTC::load_tls({options.tls_authority, options.tls_key, ""}))
        arguments.push_back(argument);
    return arguments;
}

// The options are those of rtm_host. The time limit for calls also applies to the first call of a connection, which
// omniORB limits separately. The manager has no rtc.conf, log, name server or servant, because only this program's
// ports use it.
CORBA::ORB_ptr manager_orb(unsigned long timeout_ms, const RtmClientOptions& options) {
    coil::vstring arguments{"tandem",
                            "-f",
                            "/dev/null",
                            "-o",
                            "logger.enable:NO",
                            "-o",
                            "naming.enable:NO",
                            "-o",
                            "manager.corba_servant:NO",
                            "-o",
                            "corba.endpoints:" + (options.endpoint.empty() ? "" : options.endpoint + ":"),
                            "-o",
                            std::string("corba.permitted_hosts:") + (options.endpoint.empty() ? "" : "all"),
                            "-o",
                            "corba.args:-ORBclientCallTimeOutPeriod " + std::to_string(timeout_ms) +
                                " -ORBclientConnectTimeOutPeriod " +
                                std::to_string(std::min(timeout_ms, 2000UL))};
    if (!options.tls_key.empty() || !options.tls_authority.empty())
        for (const auto& setting : {"corba.ssl.certificate_authority_file:" + options.tls_authority,
                                    "corba.ssl.key_file:" + options.tls_key}) {
            arguments.emplace_back("-o");
            arguments.push_back(setting);
        }
    coil::Argv argv(arguments);
    return RTC::Manager::start(static_cast<int>(argv.size()), argv.get(), {}).getORB();
}

// The variable is a list separated by ';', as in rtshell.
std::vector<std::string> default_name_servers() {
    const char* names = std::getenv("RTCSH_NAMESERVERS");
    const auto list = coil::split(names ? names : "", ";", true);
    return list.empty() ? std::vector<std::string>{"localhost"} : list;
}

} // namespace

RtmClient::RtmClient(const RtmClientOptions& options, bool with_manager)
    : timeout_ms_(static_cast<unsigned long>(options.timeout_s * 1000)), with_manager_(with_manager),
      has_explicit_sources_(!options.name_servers.empty() || !options.managers.empty()),
      name_servers_(has_explicit_sources_ ? options.name_servers : default_name_servers()),
      managers_(has_explicit_sources_ ? std::optional(options.managers) : std::nullopt) {
    // A path without a server refers to the first named server, or to the first default server if only managers are
    // named.
    path_server_ = RTC::with_default_port(
        name_servers_.empty() ? default_name_servers().front() : name_servers_.front(), 2809);
    if (with_manager) {
        orb_ = manager_orb(timeout_ms_, options);
    } else {
        coil::Argv argv(orb_arguments(timeout_ms_, options));
        int argc = static_cast<int>(argv.size());
        orb_ = CORBA::ORB_init(argc, argv.get(), "omniORB4");
    }
    for (auto& server : name_servers_) server = RTC::with_default_port(server, 2809);
    if (managers_)
        for (auto& manager : *managers_) manager = RTC::with_default_port(manager, 2810);
}

RtmClient::~RtmClient() {
    try {
        if (with_manager_)
            RTC::Manager::instance().shutdown();
        else
            orb_->destroy();
    } catch (const CORBA::Exception&) {
        // The ORB is already shut down, as intended.
    }
}

// Searches only when needed: explicit sources, or an address of one place, need no search.
const std::vector<std::string>& RtmClient::managers() const {
    if (!managers_) managers_ = find_local_managers(orb_.in());
    return *managers_;
}

// Polls, because managers do not report the creation of a component.
RemoteComponent RtmClient::find_component(const std::string& name) const {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(timeout_ms_);
    bool was_being_created = false;
    for (;;) {
        try {
            return search_component(name);
        } catch (const RTC::ComponentBeingCreated& e) {
            if (std::chrono::steady_clock::now() > deadline)
                throw std::runtime_error(fmt::format("{}; allow more time with --timeout", e.what()));
        } catch (const std::runtime_error& e) {
            if (!was_being_created) throw;
            throw std::runtime_error(fmt::format("{}; its creation failed: see its host's log", e.what()));
        }
        was_being_created = true;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
}

RemoteComponent RtmClient::search_component(const std::string& name) const {
    // Requests the profile at once, because messages show the instance name, whatever name was given.
    auto found = [&](const std::string& address) {
        RemoteComponent component{RTC::resolve_component(orb_.in(), address, name_servers_, timeout_ms_),
                                  address, ""};
        return call_remote(address, [&] {
            RTC::ComponentProfile_var profile = component.object->get_component_profile();
            component.instance = profile->instance_name;
            return component;
        });
    };
    // An address or a path refers to one place; only a plain name is looked up everywhere.
    if (name.find("://") != std::string::npos) return found(name);
    if (name.find('/') != std::string::npos) return found("rtcname://" + path_server_ + "/" + name);
    // In managers, component names do not include the kind of the name server's name.
    const bool has_kind = name.size() > 4 && name.compare(name.size() - 4, 4, ".rtc") == 0;
    const std::string plain = has_kind ? name.substr(0, name.size() - 4) : name;
    std::vector<std::string> reasons;
    std::optional<RTC::ComponentBeingCreated> being_created;
    // Skips only sources without the component. If the component is found but does not answer, its error ends the
    // search.
    auto attempt = [&](const std::string& address) -> std::optional<RemoteComponent> {
        try {
            return found(address);
        } catch (const RTC::ComponentBeingCreated& e) {
            being_created = e;
            return std::nullopt;
        } catch (const RTC::RemoteUnavailable& e) {
            reasons.push_back(e.what());
            return std::nullopt;
        }
    };
    // Managers first, because name servers may contain names of dead processes.
    for (const auto& manager : managers())
        if (auto component = attempt("rtcloc://" + manager + "/" + plain)) return *component;
    for (const auto& server : name_servers_)
        if (auto component = attempt("rtcname://" + server + "/*/" + plain)) return *component;
    if (being_created) throw RTC::ComponentBeingCreated(*being_created);
    throw std::runtime_error(
        fmt::format("component {} not found ({}); see tandem rtm list", name, fmt::join(reasons, "; ")));
}

RemotePort get_port(const RemoteComponent& component, const std::string& port) {
    return call_remote(component.address, [&] {
        RemotePort found;
        found.object = CORBA_RTCUtil::get_port_by_name(component.object.in(), port);
        if (CORBA::is_nil(found.object.in())) {
            const auto names = CORBA_RTCUtil::get_port_names(component.object.in());
            throw std::runtime_error(
                fmt::format("{} has no port {} (it has: {})", component.instance, port,
                            names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
        }
        found.profile = found.object->get_port_profile();
        found.name = found.profile->name;
        return found;
    });
}

RemotePort find_port(const RtmClient& client, const std::string& name) {
    // rtcname://host:2809/a.host_cxt/Name0.rtc:out, Name0:out, Name0.out. The port follows the last ':' or '.' after
    // the last '/'. Before it, these characters belong to addresses and to kinds of names.
    const std::size_t last = name.rfind('/') == std::string::npos ? 0 : name.rfind('/');
    std::size_t at = name.find(':', last);
    if (at == std::string::npos) at = name.rfind('.');
    if (at == std::string::npos || at <= last || at + 1 == name.size())
        throw std::runtime_error("`" + name + "` is not a port; expected COMPONENT:PORT");
    return get_port(client.find_component(name.substr(0, at)), name.substr(at + 1));
}

std::vector<RTC::ExecutionContext_var> execution_contexts(RTC::RTObject_ptr component) {
    std::vector<RTC::ExecutionContext_var> all;
    RTC::ExecutionContextList_var own = component->get_owned_contexts();
    RTC::ExecutionContextList_var others = component->get_participating_contexts();
    for (auto* list : {&own, &others})
        for (CORBA::ULong i = 0; i < (*list)->length(); ++i)
            all.emplace_back(RTC::ExecutionContext::_duplicate((*list)[i]));
    if (all.empty()) throw std::runtime_error("the component has no execution context");
    return all;
}

// A component has a state in each context. ERROR and ACTIVE override the state in earlier contexts.
std::string component_state(RTC::RTObject_ptr component) {
    static const char* const names[] = {"CREATED", "INACTIVE", "ACTIVE", "ERROR"};
    std::string state = "NONE";
    RTC::ExecutionContextList_var own = component->get_owned_contexts();
    RTC::ExecutionContextList_var others = component->get_participating_contexts();
    for (auto* list : {&own, &others})
        for (CORBA::ULong i = 0; i < (*list)->length(); ++i) {
            const std::string one = names[(*list)[i]->get_component_state(component)];
            if (state == "NONE" || state == "CREATED" || one == "ERROR" || one == "ACTIVE") state = one;
            if (state == "ERROR") return state;
        }
    return state;
}

std::string active_configuration_set(SDOPackage::Configuration_ptr configuration) {
    try {
        SDOPackage::ConfigurationSet_var set = configuration->get_active_configuration_set();
        return static_cast<const char*>(set->id);
    } catch (const SDOPackage::NotAvailable&) { // OpenRTM-aist's answer before the first activation
        return "";
    }
}

std::string to_string(RTC::ReturnCode_t code) {
    // In the order of RTC::ReturnCode_t.
    static const char* const texts[] = {"OK",
                                        "it reports an error",
                                        "it refuses the request",
                                        "it does not support this",
                                        "it is out of resources",
                                        "its state does not allow this"};
    return code <= RTC::PRECONDITION_NOT_MET ? texts[code] : "code " + std::to_string(static_cast<int>(code));
}

void throw_corba_error(const std::string& address, const CORBA::Exception& e) {
    throw std::runtime_error(address + ": " + RTC::describe_exception(e));
}

} // namespace tandem::command
