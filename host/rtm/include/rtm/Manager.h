// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_MANAGER_H
#define RTC_MANAGER_H
#include <algorithm>
#include <chrono>
#include <cmath>
#include <coil/ClockManager.h>
#include <coil/Logger.h>
#include <coil/Timer.h>
#include <functional>
#include <iostream>
#include <memory>
#include <mutex>
#include <rtm/ECFactory.h>
#include <rtm/Factory.h>
#include <rtm/ManagerActionListener.h>
#include <rtm/RTC.h>
#include <rtm/RTObject.h>
#include <rtm/SystemLogger.h>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace RTM {
class ManagerServant;
}

namespace RTC {

class Manager;
class NamingManager;
using ModuleInitProc = void (*)(Manager*);

/// Ours: an error in rtc.conf, or in a module, component or connection that it names. what() is one line.
class ManagerError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The only manager of a process: ORB, configuration, modules, components. Its owner calls init(), activateManager()
/// and runManager() in this order [main-thread]. All other functions: [any-thread].
class Manager {
  public:
    struct Options; // host/rtm/runtime/manager/manager_options.hpp: set only by rtm_host

    /// Reads the command line (-f FILE, -o key:value, -d, -i, -p PORT) and rtc.conf, and starts the ORB. Further
    /// calls return the running manager. Bad input ends the process with one line on standard error.
    static Manager* init(int argc, char** argv);
    /// Returns the running manager. Starts one without arguments if init() has not been called.
    static Manager& instance();
    /// Ours: like init(), with Tandem's options, but throws ManagerError for bad input.
    static Manager& start(int argc, char** argv, const Options& options);
    ~Manager();
    Manager(const Manager&) = delete;
    Manager& operator=(const Manager&) = delete;

    void setModuleInitProc(ModuleInitProc proc);
    /// Loads the modules, and creates, connects and activates the components that the configuration names. Calls the
    /// module init procedure. Logs and skips errors of the configuration, as in OpenRTM-aist. Returns true.
    bool activateManager();
    /// Ours: like activateManager(), but throws ManagerError at the first error.
    void activateOrThrow();
    /// Blocks until terminate(), unless `no_block`.
    void runManager(bool no_block = false);
    /// Requests the end: runManager() returns after an orderly stop. Safe in a signal handler.
    static void terminate();
    void join();
    /// Deactivates and finalizes all components in reverse order of creation, then ends the ORB. Ours: returns false if a
    /// component did not stop in time and was left behind. In code of a component, and, once activateManager() or
    /// runManager() has been called, in any thread but that of init(), requests this and returns true at once.
    bool shutdown();
    /// Ours: returns the result of shutdown().
    bool stoppedInOrder() const;
    /// Ours: returns true if a tool has requested a restart of the program after shutdown().
    bool restartRequested() const;
    /// Ours: returns true if terminate() has been called.
    static bool terminationRequested();

    coil::Properties& getConfig();
    std::string& getLogLevel();

    // Modules
    ReturnCode_t load(const std::string& file_name, const std::string& init_function);
    /// Ours: throws ManagerError. An empty `init_function` means `<file base name>Init`.
    void loadOrThrow(const std::string& file_name, const std::string& init_function);
    /// Ours: creates and deletes one component of each type without initializing it, and calls `before` with the name
    /// of each step. Returns the type whose destructor has not returned within `timeout`, after which it deletes no
    /// further component, or an empty string. Throws ManagerError.
    std::string tryFactories(const std::function<void(const std::string&)>& before,
                             std::chrono::nanoseconds timeout);
    /// Removes a module's component types. The module's code stays loaded for remaining users. Returns
    /// PRECONDITION_NOT_MET while components of the module exist.
    ReturnCode_t unload(const char* file_name);
    void unloadAll();
    std::vector<coil::Properties> getLoadedModules();
    std::vector<coil::Properties> getLoadableModules();

    // Factories
    bool registerFactory(coil::Properties& profile, RtcNewFunc new_func, RtcDeleteFunc delete_func);
    std::vector<coil::Properties> getFactoryProfiles();
    bool registerECFactory(const char* name, ECNewFunc new_func, ECDeleteFunc delete_func);
    std::vector<std::string> getModulesFactories();

    // Components
    /// `Name` or `Name?key=value&...`. Returns NULL if there is no such type or onInitialize() fails.
    RTObject_impl* createComponent(const char* comp_args);
    /// Ours: throws ManagerError.
    RTObject_impl& createOrThrow(const std::string& comp_args);
    ExecutionContextBase* createContext(const char* ec_args);
    bool registerComponent(RTObject_impl* comp);
    bool unregisterComponent(RTObject_impl* comp);
    void deleteComponent(RTObject_impl* comp);
    void deleteComponent(const char* instance_name);
    /// Finds a component by instance name. Returns NULL if there is none.
    RTObject_impl* getComponent(const char* instance_name);
    std::vector<RTObject_impl*> getComponents();
    /// Notes that a component has left through exit(). The manager's thread deletes it later.
    void notifyFinalized(RTObject_impl* comp);
    void cleanupComponent(RTObject_impl* comp) { unregisterComponent(comp); }
    void cleanupComponents();

    /// Ours: makes the connection of one line of manager.components.preconnect, `A.p?port=B.q&key=value...`. Throws
    /// ManagerError.
    void connectOrThrow(const std::string& line);
    /// Ours: activates a component in its contexts. Throws ManagerError.
    void activateComponentOrThrow(const std::string& instance_name);
    /// Ours, lock-step: runs one cycle of the component's own contexts in the calling thread. Throws ManagerError.
    void step(const std::string& instance_name);

    /// Runs fn later in the manager's thread.
    void invoke(std::function<void()> fn, std::chrono::nanoseconds delay = std::chrono::nanoseconds::zero());

    using TaskId = coil::PeriodicFunction*;
    /// Runs fn in the manager's thread once per period, until removeTask().
    TaskId addTask(std::function<void()> fn, std::chrono::nanoseconds period);
    static void removeTask(TaskId id) { id->stop(); }

    /// Returns the buffer whose streams get every log line of the process.
    LogStreamBuf& getLogStreamBuf() { return Logger::processStreams(); }
    NamingManager* getNaming();

    void addManagerActionListener(RTM::ManagerActionListener* listener, bool autoclean = true);
    void removeManagerActionListener(RTM::ManagerActionListener* listener);
    void addModuleActionListener(RTM::ModuleActionListener* listener, bool autoclean = true);
    void removeModuleActionListener(RTM::ModuleActionListener* listener);
    void addRtcLifecycleActionListener(RTM::RtcLifecycleActionListener* listener, bool autoclean = true);
    void removeRtcLifecycleActionListener(RTM::RtcLifecycleActionListener* listener);
    void addNamingActionListener(RTM::NamingActionListener* listener, bool autoclean = true);
    void removeNamingActionListener(RTM::NamingActionListener* listener);

    // CORBA. get...() returns a duplicated reference, which the caller releases. the...() returns one that the caller
    // does not release.
    CORBA::ORB_ptr theORB();
    CORBA::ORB_ptr getORB();
    PortableServer::POA_ptr thePOA();
    PortableServer::POA_ptr getPOA();
    /// Returns a POA whose objects are called within the process without omniORB's dispatcher.
    PortableServer::POA_ptr theShortCutPOA();
    PortableServer::POA_ptr getShortCutPOA();
    PortableServer::POAManager_ptr thePOAManager();
    PortableServer::POAManager_ptr getPOAManager();
    /// Returns the manager as a CORBA object.
    RTM::ManagerServant& getManagerServant();

    struct Impl;
    Impl& impl() { return *m_impl; }

  private:
    explicit Manager(const Options& options);
    RTObject_impl& makeOrThrow(FactoryBase& factory);
    /// Loads the library with the name of the component type. Returns false if there is none.
    bool loadForType(const std::string& type);
    bool stopComponents(std::vector<RTObject_impl*> components);
    std::unique_ptr<Impl> m_impl;
};

} // namespace RTC
#endif
