// SPDX-License-Identifier: Apache-2.0
// The state of RTC::Manager, which OpenRTM-aist has as protected members of the class. Private to
// host/rtm/runtime: the public header rtm/Manager.h only names the type.
#pragma once
#include "host/plugin/library.hpp"
#include "host/rtm/runtime/manager/connection_keeper.hpp"
#include "host/rtm/runtime/manager/manager_options.hpp"
#include "host/rtm/runtime/manager/probe_module.hpp"
#include "host/rtm/runtime/manager/slow_transitions.hpp"
#include "host/rtm/runtime/naming/component_creation.hpp"
#include "host/rtm/runtime/naming/name_bindings.hpp"
#include "host/rtm/runtime/naming/port_topics.hpp"
#include <atomic>
#include <condition_variable>
#include <map>
#include <rtm/ManagerActionListener.h>
#include <rtm/ManagerServant.h>
#include <rtm/NamingManager.h>
#include <set>
#include <thread>

namespace RTC {
class LogstreamBase;

struct Manager::Impl {
    // Set once by Manager::start(), before there are other threads; read by any thread afterwards.
    Options options;
    std::filesystem::path conf_file; // empty: no file was read
    Logger log{"manager"};
    ModuleInitProc init_proc = nullptr;
    std::unique_ptr<ModuleProbes> probes; // NULL: modules are loaded untried

    CORBA::ORB_var orb;
    PortableServer::POA_var poa, shortcut_poa;
    PortableServer::POAManager_var poa_manager;
    std::unique_ptr<NameBindings> name_bindings; // has no servers when naming is off
    std::unique_ptr<PortTopics> port_topics;
    std::unique_ptr<NamingManager> naming_manager;
    std::unique_ptr<ConnectionKeeper> connection_keeper;
    PortableServer::Servant_var<RTM::ManagerServant> servant;

    struct Module {
        std::string name; // as it was given to load()
        std::shared_ptr<tandem::plugin::Library> library;
    };
    struct Component {
        RTObject_impl* object;
        std::shared_ptr<FactoryBase> factory; // shared, because a tool may unload the module meanwhile
    };
    struct ContextType {
        ECNewFunc create;
        ECDeleteFunc destroy;
    };
    // Guards what follows. Recursive, because functions that hold it call others that take it. Not held
    // while callbacks of components run: they call the manager, even from threads that they start.
    mutable std::recursive_mutex mutex;
    coil::Properties config; // Manager::getConfig() hands it out without the mutex, as OpenRTM-aist does
    std::vector<Module> modules;
    std::set<std::shared_ptr<tandem::plugin::Library>> libraries; // with those of unloaded modules
    std::vector<std::shared_ptr<FactoryBase>> factories;
    std::map<std::string, ContextType> contexts;
    std::vector<Component> components; // in the order of their creation
    std::vector<Component> finalized;  // exited, deleted by the next cleanupComponents()
    struct Creation {
        RTObject_impl* component =
            nullptr; // set from the start of its initialize() on; NULL if that has failed
        std::string type;
        std::chrono::steady_clock::time_point since;
    };
    std::map<std::string, Creation> being_created; // by the names of the components, which are not listed yet
    std::vector<std::pair<std::chrono::steady_clock::time_point, std::function<void()>>> tasks; // by due time
    std::vector<std::shared_ptr<coil::PeriodicFunction>> periodic_tasks;
    bool shut_down = false;    // the end has begun
    coil::vstring left_behind; // what did not return when the manager was shut down
    // Who ends the manager: see manager_end.cpp.
    std::thread::id owner;     // the thread of start()
    std::thread::id main_loop; // the thread of runManager() until it returns
    std::thread::id ending;    // the thread that ends the manager
    bool is_run = false;       // activateManager() or runManager() has been called
    bool setting_up = false;   // the configuration is being carried out
    bool end_requested = false, has_ended = false, ended_in_order = false;
    std::condition_variable_any end_changed; // of setting_up and has_ended

    SlowTransitions slow_transitions; // used by the main thread only, without the mutex

    std::atomic<bool> ever_had_components{false};
    std::atomic<bool> restart_requested{false};

    std::vector<LogstreamBase*> log_streams; // created by open_log_streams()

    RTM::ManagerActionListeners listeners;

    /// Returns a copy of the current settings: tools change them while components are created from them.
    coil::Properties config_snapshot() const;
    std::string setting(const std::string& key) const;
    /// Applies a setting that a tool makes. Returns false if the key cannot have the value.
    bool change_setting(const std::string& key, std::string value);
    /// Returns the factory that matches the properties of `id`, or NULL. Empty properties match any. Call it with the
    /// mutex held.
    std::shared_ptr<FactoryBase> find_factory(const coil::Properties& id);
    /// Returns the factory for `id`. Loads a library of the type's name if necessary (manager.modules.search_auto).
    /// Throws ManagerError if there is none.
    std::shared_ptr<FactoryBase> require_factory(Manager& manager, const coil::Properties& id);
    /// Throws ManagerError when the component cannot be configured or initialized.
    void set_up_component(RTObject_impl& component, const std::string& name, FactoryBase& factory,
                          const coil::Properties& arguments);
    void begin_initialization(RTObject_impl& component, const std::string& name);
    std::vector<ComponentCreation> creations() const;
    void discard_component(RTObject_impl& component, std::shared_ptr<FactoryBase> factory);
    /// Throws ManagerError, with the names of all components, if there is no component of that name.
    RTObject_impl& require_component(Manager& manager, const std::string& name);
    /// Returns the folders that are searched for modules, in order.
    std::vector<std::filesystem::path> module_dirs() const;
    struct ModuleFile {
        std::filesystem::path file;
        std::string init; ///< its init function
        bool trusted;     ///< needs no probe
    };
    /// Finds a module and reads what can be read without loading it. Throws ManagerError or tandem::plugin::Error.
    ModuleFile find_module(const std::string& name, const std::string& init_function) const;
    /// Activates the component in its own contexts. If a context has not activated it when the context answers, logs
    /// why.
    void activate(RTObject_impl& component);
    /// Activates a component of another process in its first own context, and logs the result. Throws RemoteUnavailable.
    void activate_remote(const std::string& name);
    /// Logs slow callbacks of transitions, and their end. [main-thread]
    void log_slow_transitions();
    /// Runs the tasks of invoke() and addTask() whose time has come. [main-thread]
    void run_due_tasks();
    bool has_components() const;
    std::chrono::steady_clock::time_point next_round() const; ///< [main-thread]
    /// Deletes components that have exited. Without the mutex: a destructor may call the manager.
    void destroy(const std::vector<Component>& exited);
    /// Calls the functions, each of which ends with the destructor of the component of that name, in a separate thread. If one
    /// does not return in time, logs that and leaves the thread behind.
    void run_destructors(const std::vector<std::pair<std::string, std::function<void()>>>& destructors);
    void set_setting_up(bool value);
    /// No thread: there is no main loop any more.
    void set_main_loop(std::thread::id thread);
    void note_run();
    /// Ends everything, or waits until the thread that does so has ended. Returns false if a component was left behind.
    bool end(Manager& manager);
    struct EndNotice;
    /// Performs the steps of end(). Returns false if a component was left behind. [one thread]
    bool end_in_order(Manager& manager);
    /// Returns whether the manager cannot end before the caller has returned, because a component's code or a task of the
    /// main loop has called. Requires the mutex.
    bool must_return_first() const;
    /// Requests the end of the manager and returns. The main loop ends it, or a new thread if there is no main loop.
    void request_end(Manager& manager);
    /// Makes exit() wait for the requested end, for twice the stop timeout at most.
    static void wait_for_end_at_exit();
    /// Logs that a component's code does not return, and notes it for left_behind().
    void leave_behind(const std::string& what);
    void begin_setup_step(std::string step) const {
        if (options.on_setup_step) options.on_setup_step(std::move(step));
    }
    void schedule_periodic(Manager& manager, const std::shared_ptr<coil::PeriodicFunction>& task,
                           std::chrono::nanoseconds period);
    /// Returns references to the components that `accept` returns true for. They stay valid if a component exits
    /// meanwhile; calls then raise OBJECT_NOT_EXIST.
    std::vector<RTObject_var> references(const std::function<bool(RTObject_impl&)>& accept =
                                             [](RTObject_impl&) { return true; }) const;
};

/// Wakes the main loop, which sleeps until its next task is due, and makes it check everything now. Takes one system
/// call. [any-thread, async-signal-safe]
void wake_main_loop();

/// Merges defaults, rtc.conf and command line into impl.config, opens the log and pins the process to the
/// processors of manager.cpu_affinity. Throws ManagerError.
void configure_process(Manager::Impl& impl, int argc, char** argv);
/// Starts to try the modules that rtc.conf names (HostOptions::probe). Errors are reported when the module is loaded.
void begin_module_probes(Manager::Impl& impl);
/// Initializes ORB, POAs and name bindings. Throws ManagerError, for example when the endpoint is in use.
void start_orb(Manager::Impl& impl);
/// Starts the supervision of connections with other processes and of the names in name servers.
void start_connection_keeper(Manager& manager, Manager::Impl& impl);
/// Makes the manager reachable as corbaloc:iiop:HOST:PORT/manager, and binds its names.
void publish_manager(Manager& manager, Manager::Impl& impl);
/// Unbinds the names of the manager and those bound through NamingManager.
void unpublish_manager(Manager::Impl& impl);

/// Creates the log streams that are configured (logger.logstream.*). Throws ManagerError.
void open_log_streams(Manager::Impl& impl);
void close_log_streams(Manager::Impl& impl);

} // namespace RTC
