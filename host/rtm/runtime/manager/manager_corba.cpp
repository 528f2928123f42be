// SPDX-License-Identifier: Apache-2.0
// The manager's ORB, POAs and its own CORBA object. OpenRTM-aist: Manager::initORB(), createORBOptions(),
// createORBEndpoints(), initNaming() and ManagerServant::createINSManager().
#include "host/local/local_endpoint.hpp"
#include "host/process/start_thread.hpp"
#include "host/rtm/runtime/configuration/format_name.hpp"
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include "host/rtm/runtime/network/access.hpp"
#include "host/rtm/runtime/network/connection_limits.hpp"
#include "host/rtm/runtime/network/network_sockets.hpp"
#include "host/rtm/runtime/network/peer_machine.hpp"
#include "host/rtm/runtime/network/request_admission.hpp"
#include "host/rtm/runtime/network/tls.hpp"
#include "host/rtm/runtime/upcall/servant_owners.hpp"
#include <algorithm>
#include <omniORB4/omniPolicy.h>
#include <omnithread.h>

namespace RTC {
namespace {

std::string transport() { return uses_tls() ? "giop:ssl:" : "giop:tcp:"; }

// HOST or HOST:PORT; colons within brackets are those of an address of IPv6.
bool has_port(const std::string& address) {
    const std::size_t bracket = address.rfind(']');
    return address.find(':', bracket == std::string::npos ? 0 : bracket) != std::string::npos;
}

// The endpoint of a master manager: the port of corba.master_manager, at every address if another endpoint is.
std::string master_endpoint(const coil::Properties& config, const std::vector<std::string>& others) {
    const std::string address = config.getProperty("corba.master_manager", "2810");
    const std::string port = address.substr(address.rfind(':') + 1); // [HOST]:PORT or PORT
    const bool everywhere = std::any_of(others.begin(), others.end(), [](const std::string& other) {
        return other.compare(0, 10, "giop:tcp::") == 0 || other.compare(0, 10, "giop:ssl::") == 0;
    });
    return transport() + (everywhere ? "" : "127.0.0.1") + ":" + port;
}

coil::vstring name_servers(const coil::Properties& config) {
    const auto servers = coil::split(config.getProperty("corba.nameservers"), ",", true);
    const bool enabled = coil::toBool(config.getProperty("naming.enable"), "YES", "NO", !servers.empty());
    if (!enabled) return {};
    return servers.empty() ? coil::vstring{"localhost"} : servers;
}

// Values of corba.endpoints (or the older corba.endpoint) in omniORB's form: `all`, `HOST:PORT`, `HOST:`, `HOST`, or
// already `giop:...`; by TLS if it is set up. They are preceded by the endpoint at which tools and other managers find
// a master. Clients that read a name from a name server may not support Unix sockets (Java). Without such a reason the
// list is empty, and no port is open.
std::vector<std::string> tcp_endpoints(const coil::Properties& config) {
    std::vector<std::string> out;
    std::string list = config.getProperty("corba.endpoints");
    if (!config.getProperty("corba.endpoint").empty()) list = config.getProperty("corba.endpoint");
    if (list.empty() && !name_servers(config).empty()) list = "127.0.0.1:";
    for (const auto& endpoint : coil::split(list, ",", true)) {
        if (coil::normalize(endpoint) == "all")
            out.push_back(transport() + ":");
        else if (uses_tls() && endpoint.compare(0, 9, "giop:tcp:") == 0)
            throw ManagerError("corba.endpoints: " + endpoint +
                               " would be open to everyone without TLS, which corba.ssl.* sets up: expected "
                               "HOST:PORT or giop:ssl:HOST:PORT");
        else if (endpoint.compare(0, 5, "giop:") == 0)
            out.push_back(endpoint);
        else
            out.push_back(transport() + endpoint + (has_port(endpoint) ? "" : ":"));
    }
    if (!coil::toBool(config.getProperty("manager.is_master"), "YES", "NO", false)) return out;
    const std::string master = master_endpoint(config, out);
    if (std::find(out.begin(), out.end(), master) == out.end()) out.insert(out.begin(), master);
    return out;
}

// Options of omniORB. Those of corba.args come last, so that they win.
coil::vstring orb_arguments(const coil::Properties& config) {
    coil::vstring args{"tandem"};
    const TlsFiles tls{config.getProperty("corba.ssl.certificate_authority_file"),
                       config.getProperty("corba.ssl.key_file"),
                       config.getProperty("corba.ssl.key_file_password")};
    for (const auto& argument : load_tls(tls)) args.push_back(argument);
    auto add = [&](const char* option, const std::string& value) {
        args.push_back(option);
        args.push_back(value);
    };
    add("-ORBunixTransportPermission", "0600");
    add("-ORBendPoint",
        "giop:unix:" + tandem::local::make_local_endpoint(tandem::local::manager_endpoint).native());
    for (const auto& endpoint : tcp_endpoints(config)) add("-ORBendPoint", endpoint);
    add("-ORBclientCallTimeOutPeriod", "10000");   // ms; no call waits without end
    add("-ORBclientConnectTimeOutPeriod", "2000"); // ms; of another machine, which may be off
    add("-ORBgiopMaxMsgSize", "67108864");         // 64 MiB: camera images and point clouds fit
    // Limits the simultaneous calls of one process, each on a separate connection: the calls of each NewestPush,
    // services, checks.
    add("-ORBmaxGIOPConnectionPerServer", "200");
    for (const auto& argument : thread_limit_options()) args.push_back(argument);
    add("-ORBtraceLevel", "0"); // this runtime reports errors itself, in one line each
    for (const auto& arg : coil::parseArgs(config.getProperty("corba.args"))) args.push_back(arg);
    return args;
}

// Calls of objects in this POA within this process go directly to the servant, without a dispatcher.
PortableServer::POA_ptr make_shortcut_poa(PortableServer::POA_ptr root,
                                          PortableServer::POAManager_ptr manager) {
    CORBA::PolicyList policies;
    policies.length(1);
    policies[0] = omniPolicy::create_local_shortcut_policy(omniPolicy::LOCAL_CALLS_SHORTCUT);
    return root->create_POA("shortcut", manager, policies);
}

coil::vstring manager_names(const Manager::Impl& impl) {
    coil::Properties self;
    self.setProperty("instance_name", impl.config.getProperty("manager.instance_name"));
    coil::vstring names;
    const std::string formats = impl.config.getProperty("manager.naming_formats");
    for (const auto& format : coil::split(formats, ",", true))
        names.push_back(format_name(format, self, impl.config));
    return names;
}

bool is_loopback(const std::string& endpoint) {
    const std::string host = parse_giop_address(endpoint).host;
    return host.compare(0, 4, "127.") == 0 || host == "::1" || host == "localhost";
}

// Which other machines may do what, for the line about open ports.
std::string permitted_machines(const AccessRules& rules) {
    if (rules.hosts.empty() && !uses_tls()) return "nobody (corba.permitted_hosts names machines)";
    std::string who = rules.hosts.empty() ? "everyone" : coil::flatten(rules.hosts);
    if (uses_tls()) who += " with a certificate";
    return who + ", who may connect, activate and configure components" +
           (rules.remote_load ? ", load code" : "") +
           (rules.remote_shutdown ? ", end them and this process" : "");
}

// Other users and machines can reach this process only by TCP.
void report_open_ports(const Manager::Impl& impl) {
    const auto open = tcp_endpoints(impl.config);
    if (open.empty()) return;
    const AccessRules rules = read_access_rules(impl.config);
    std::string who = "processes of this user";
    if (!rules.users.empty()) who += " and of " + coil::flatten(rules.users);
    if (!std::all_of(open.begin(), open.end(), is_loopback))
        who += "; from other machines " + permitted_machines(rules);
    Logger rtclog = impl.log;
    RTC_INFO(("open by TCP at %s to %s", coil::flatten(open).c_str(), who.c_str()));
}

} // namespace

void start_orb(Manager::Impl& impl) {
    coil::vstring arguments;
    try {
        arguments = orb_arguments(impl.config);
        set_connection_limits(read_connection_limits(impl.config));
    } catch (const ManagerError&) {
        throw; // already names its key
    } catch (const std::runtime_error& e) {
        throw ManagerError(std::string("the ORB cannot start: ") + e.what());
    }
    coil::Argv argv(arguments);
    int argc = static_cast<int>(argv.size());
    name_upcalls();
    OrbSocketsAtFork sockets;
    try {
        impl.orb = CORBA::ORB_init(argc, argv.get(), "omniORB4");
        refuse_excess_connections();
        set_up_network_sockets();
        set_up_request_deadlines();
        control_access(read_access_rules(impl.config));
        CORBA::Object_var object = impl.orb->resolve_initial_references("RootPOA");
        impl.poa = PortableServer::POA::_narrow(object.in());
        impl.poa_manager = impl.poa->the_POAManager();
        impl.shortcut_poa = make_shortcut_poa(impl.poa.in(), impl.poa_manager.in());
        impl.poa_manager->activate();
        sockets.set_up();
    } catch (const CORBA::INITIALIZE&) {
        const std::string args = impl.config.getProperty("corba.args");
        throw ManagerError("the ORB cannot start: is the endpoint " +
                           coil::flatten(tcp_endpoints(impl.config)) +
                           " (corba.endpoints; manager.is_master adds corba.master_manager) in use or not an "
                           "address of this machine" +
                           (uses_tls() ? ", a file or the password of corba.ssl.* wrong" : "") +
                           (args.empty() ? "?" : ", or an option of corba.args wrong (" + args + ")?"));
    } catch (const omni_thread_fatal& e) {
        throw ManagerError(tandem::process::NotStarted(e.error, "the ORB cannot start a thread").what());
    } catch (const CORBA::Exception& e) {
        throw ManagerError(std::string("the ORB cannot start: CORBA exception ") + e._name());
    }
    impl.name_bindings = std::make_unique<NameBindings>(impl.orb.in(), name_servers(impl.config));
    impl.port_topics = std::make_unique<PortTopics>(impl.orb.in(), *impl.name_bindings);
    report_open_ports(impl);
}

// The object is activated in omniINSPOA, whose objects have the key that corbaloc names.
void publish_manager(Manager& manager, Manager::Impl& impl) {
    impl.servant = new RTM::ManagerServant(manager);
    if (!coil::toBool(impl.config.getProperty("manager.corba_servant"), "YES", "NO", true)) return;
    CORBA::Object_var object = impl.orb->resolve_initial_references("omniINSPOA");
    PortableServer::POA_var poa = PortableServer::POA::_narrow(object.in());
    PortableServer::ObjectId_var id = PortableServer::string_to_ObjectId("manager");
    poa->activate_object_with_id(id.in(), impl.servant.in());
    PortableServer::POAManager_var(poa->the_POAManager())->activate();
    CORBA::Object_var reference = poa->id_to_reference(id.in());
    impl.servant->setObjRef(RTM::Manager_var(RTM::Manager::_narrow(reference.in())).in());
    Logger& rtclog = impl.log;
    for (const auto& name : manager_names(impl))
        for (const auto& error : impl.name_bindings->bind(name, reference.in()))
            RTC_WARN(("%s", error.c_str()));
}

void unpublish_manager(Manager::Impl& impl) {
    impl.naming_manager->unbindAll();
    for (const auto& name : manager_names(impl)) impl.name_bindings->unbind(name);
}

void start_connection_keeper(Manager& manager, Manager::Impl& impl) {
    auto seconds = [&](const char* key, double default_value) {
        double value = default_value;
        if (!coil::stringTo(value, impl.config.getProperty(key).c_str()) || !(value > 0))
            value = default_value;
        return std::chrono::nanoseconds(static_cast<std::int64_t>(value * 1e9));
    };
    impl.connection_keeper =
        std::make_unique<ConnectionKeeper>(manager, seconds("manager.peer_check_interval", 2));
    auto yes = [&](const char* key, bool default_value) {
        return coil::toBool(impl.config.getProperty(key), "YES", "NO", default_value);
    };
    if (!yes("naming.update.enable", true)) return;
    const bool rebind = yes("naming.update.rebind", false);
    const auto update = [&impl, rebind] {
        Logger& rtclog = impl.log;
        const auto changes = impl.name_bindings->update(rebind);
        for (const auto& line : changes) RTC_WARN(("%s", line.c_str()));
        if (changes.empty()) return;
        for (const auto& line : impl.port_topics->connect_all()) RTC_ERROR(("%s", line.c_str()));
    };
    const auto start_updates = [&impl, update, interval = seconds("naming.update.interval", 10)] {
        impl.connection_keeper->add_periodic_task(update, interval);
    };
    // Without a name server there is nothing to update, so the thread need not wake up for it.
    impl.name_bindings->set_on_first_server(start_updates);
    if (!impl.name_bindings->servers().empty()) start_updates();
}

RTM::ManagerServant& Manager::getManagerServant() { return *m_impl->servant; }
NamingManager* Manager::getNaming() { return m_impl->naming_manager.get(); }

CORBA::ORB_ptr Manager::theORB() { return m_impl->orb.in(); }
CORBA::ORB_ptr Manager::getORB() { return CORBA::ORB::_duplicate(m_impl->orb.in()); }
PortableServer::POA_ptr Manager::thePOA() { return m_impl->poa.in(); }
PortableServer::POA_ptr Manager::getPOA() { return PortableServer::POA::_duplicate(m_impl->poa.in()); }
PortableServer::POA_ptr Manager::theShortCutPOA() { return m_impl->shortcut_poa.in(); }
PortableServer::POA_ptr Manager::getShortCutPOA() {
    return PortableServer::POA::_duplicate(m_impl->shortcut_poa.in());
}
PortableServer::POAManager_ptr Manager::thePOAManager() { return m_impl->poa_manager.in(); }
PortableServer::POAManager_ptr Manager::getPOAManager() {
    return PortableServer::POAManager::_duplicate(m_impl->poa_manager.in());
}

} // namespace RTC
