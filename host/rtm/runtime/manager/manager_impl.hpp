// SPDX-License-Identifier: Apache-2.0
// The manager's state. Internal to host/rtm.
#pragma once
#include "host/plugin/library.hpp"
#include "host/rtm/runtime/configuration/conf_file.hpp"
#include "host/rtm/runtime/manager/connection_keeper.hpp"
#include "host/rtm/runtime/manager/manager_options.hpp"
#include "host/rtm/runtime/naming/name_bindings.hpp"
#include <atomic>
#include <map>
#include <rtm/ManagerActionListener.h>
#include <rtm/ManagerServant.h>
#include <rtm/NamingManager.h>
#include <set>

namespace RTC {
class LogstreamBase;

struct Manager::Impl {
    Options options;
    coil::Properties config;
    std::filesystem::path conf_file; // empty: none was read
    Logger log{"manager"};
    ModuleInitProc init_proc = nullptr;

    CORBA::ORB_var orb;
    PortableServer::POA_var poa, shortcut_poa;
    PortableServer::POAManager_var poa_manager;
    std::unique_ptr<NameBindings> name_bindings; // without servers when naming is off
    std::unique_ptr<NamingManager> naming_manager;
    std::unique_ptr<ConnectionKeeper> connection_keeper;
    PortableServer::Servant_var<RTM::ManagerServant> servant;

    struct Module {
        std::string name;
        std::shared_ptr<tandem::plugin::Library> library;
    };
    struct Component {
        RTObject_impl* object;
        std::shared_ptr<FactoryBase> factory; // which a tool may unload meanwhile
    };
    struct ContextType {
        ECNewFunc create;
        ECDeleteFunc destroy;
    };
    mutable std::recursive_mutex mutex; // guards what follows
    std::vector<Module> modules;
    std::set<std::shared_ptr<tandem::plugin::Library>> libraries; // of those that were unloaded, too
    std::vector<std::shared_ptr<FactoryBase>> factories;
    std::map<std::string, ContextType> contexts;
    std::vector<Component> components;         // in the order of their creation
    std::vector<Component> finalized;          // have left, wait for their deletion
    std::set<std::string> names_being_created; // names of those that are being created
    std::vector<std::pair<std::chrono::steady_clock::time_point, std::function<void()>>> tasks;
    std::vector<std::shared_ptr<coil::PeriodicFunction>> periodic_tasks;
    std::atomic<bool> ever_had_components{false};
    bool shut_down = false;
    std::atomic<bool> ended_in_order{true};
    std::atomic<bool> restart_wanted{false};

    std::vector<LogstreamBase*> log_streams; // from modules

    RTM::ManagerActionListeners listeners;

    /// rtc.conf as it is now: tools change it while components are created from it.
    coil::Properties settings() const;
    std::string setting(const std::string& key) const;
    /// What a tool sets; false for a value that the key cannot have.
    bool change_setting(const std::string& key, std::string value);
    std::shared_ptr<FactoryBase> find_factory(const coil::Properties& id);
    std::vector<std::filesystem::path> module_dirs() const;
    void run_due_tasks();
    /// Calls what ends with a component's destructor; one that does not return is told of and left behind.
    void destroy_component(const std::string& name, std::function<void()> call);
    void schedule_periodic(Manager& manager, const std::shared_ptr<coil::PeriodicFunction>& task,
                           std::chrono::nanoseconds period);
    /// To the components, which may leave meanwhile: to all, or to those that fit.
    std::vector<RTObject_var> references(const std::function<bool(RTObject_impl&)>& fits =
                                             [](RTObject_impl&) { return true; }) const;
};

/// Command line and rtc.conf into properties. Throws ManagerError.
void read_configuration(Manager::Impl& impl, int argc, char** argv);
/// Throws ManagerError when the ORB cannot start, for an endpoint that is taken, say.
void start_orb(Manager::Impl& impl);
/// Begins to look after connections with other processes, and after the names in name servers.
void start_connection_keeper(Manager& manager, Manager::Impl& impl);
/// Makes the manager reachable as corbaloc:...:PORT/manager, and in the name servers.
void publish_manager(Manager& manager, Manager::Impl& impl);
void unpublish_manager(Manager::Impl& impl);

/// Throws ManagerError.
void open_log_streams(Manager::Impl& impl);
void close_log_streams(Manager::Impl& impl);

/// `Name`, `Name?a=1&b=2`, `RTC:vendor:category:Name:language:version`. Throws ManagerError.
struct ComponentArguments {
    coil::Properties id;
    coil::Properties properties;
};
ComponentArguments parse_component_arguments(const std::string& args);

/// %n, %h ... of naming.formats.
std::string format_name(const std::string& format, const coil::Properties& component,
                        const coil::Properties& config);

} // namespace RTC
