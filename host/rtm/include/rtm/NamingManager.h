// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_NAMINGMANAGER_H
#define RTC_NAMINGMANAGER_H
#include <map>
#include <mutex>
#include <rtm/RTC.h>
#include <rtm/SystemLogger.h>
#include <string>
#include <vector>

namespace RTM {
class ManagerServant;
}

namespace RTC {
class Manager;
class NameBindings;
class PortBase;
class RTObject_impl;

/// The names of this process's objects in CORBA name servers, `host.host_cxt/Name0.rtc`. Manager::getNaming() returns
/// the process's object. A name server that does not answer delays no caller: it gets the names when it answers
/// again. [any-thread]
class NamingManager {
  public:
    /// Ours: `bindings`, which must outlive this object, calls the name servers.
    NamingManager(Manager* manager, NameBindings& bindings) : m_manager(manager), m_bindings(bindings) {}
    virtual ~NamingManager() = default;

    /// Adds a name server, `host` or `host:port`, which gets all names. `method` must be `corba`.
    void registerNameServer(const char* method, const char* name_server);
    void bindObject(const char* name, const RTObject_impl* rtobj);
    void bindObject(const char* name, const PortBase* port);
    void bindObject(const char* name, const RTM::ManagerServant* mgr);
    /// Binds all names again on servers that did not answer.
    void update();
    void unbindObject(const char* name);
    /// Unbinds everything that bindObject() has bound.
    void unbindAll();
    /// Returns the components among the bound objects.
    std::vector<RTObject_impl*> getObjects();
    /// Finds a component by `Name0` (this process), rtcname://HOST:PORT/CONTEXT/Name0 or rtcloc://HOST:PORT/Name0.
    /// Returns an empty list if nothing answers there.
    RTCList string_to_component(const std::string& name);
    /// Ours: like string_to_component(name), without a log line. `reason` says why the list is empty. Each call to
    /// another process ends within `timeout_ms`, and so does each later call of the returned component.
    RTCList string_to_component(const std::string& name, std::string& reason, unsigned long timeout_ms);

  private:
    void bind(const std::string& name, CORBA::Object_ptr object, const RTObject_impl* component);

    Logger rtclog{"manager"};
    Manager* m_manager;
    NameBindings& m_bindings;
    std::mutex m_mutex;
    std::map<std::string, const RTObject_impl*> m_bound; // NULL: not a component
};

} // namespace RTC
#endif
