// SPDX-License-Identifier: Apache-2.0
// Creating, finding and deleting components.
#include "host/plugin/find_library.hpp"
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include <algorithm>
#include <optional>
#include <rtm/RTObject.h>

namespace RTC {
namespace {

// What a component takes over from rtc.conf; values set there win over those of its own profile.
coil::Properties inherited(const coil::Properties& config, const coil::Properties& profile) {
    coil::Properties out;
    auto take = [&](const std::string& key) {
        const std::string set = config.getProperty(key);
        const bool only_default = set == config.getDefault(key);
        if (!set.empty() && !(only_default && !profile.getProperty(key).empty())) out.setProperty(key, set);
    };
    for (const char* key : {"config.version", "openrtm.name", "openrtm.version", "naming.formats"}) take(key);
    for (const std::string section : {"exec_cxt", "ec", "port", "sdo.service"})
        if (const auto* node = config.findNode(section))
            for (const auto& key : node->propertyNames()) take(section + "." + key);
    return out;
}

// <category>.<name>.config_file, and what rtc.conf says below <category>.<name>.
void configure_from(const coil::Properties& config, const std::filesystem::path& folder,
                    const std::string& node_name, coil::Properties& out) {
    const auto* node = config.findNode(node_name);
    if (node == nullptr) return;
    const std::string file = node->getProperty("config_file");
    if (!file.empty()) {
        std::filesystem::path path(coil::replaceEnv(file));
        if (path.is_relative() && !std::filesystem::exists(path)) path = folder / path;
        if (std::filesystem::exists(path)) {
            read_conf_file(path, out);
        } else { // as in OpenRTM-aist: configurations are handed on without the files that they name
            Logger rtclog("manager");
            RTC_WARN(("%s.config_file: there is no %s; the component has its defaults", node_name.c_str(),
                      file.c_str()));
        }
    }
    out << *node;
}

std::string listed(const std::vector<std::string>& names) {
    return names.empty() ? "none" : coil::flatten(names);
}

} // namespace

RTObject_impl& Manager::makeOrThrow(FactoryBase& factory) {
    const std::string failure =
        "component type " + factory.profile().getProperty("implementation_id") + " cannot be created";
    try {
        if (RTObject_impl* component = factory.create(this)) return *component;
    } catch (const std::exception& e) {
        throw ManagerError(failure + ": " + e.what());
    } catch (const CORBA::Exception& e) {
        throw ManagerError(failure + ": CORBA exception " + e._name());
    } catch (...) {
        throw ManagerError(failure + ": exception of unknown type");
    }
    throw ManagerError(failure + ": its factory returned NULL");
}

namespace {

// rtc.conf, the component's own files, then the arguments of its creation: the later win.
void configure(Manager::Impl& impl, RTObject_impl& component, const coil::Properties& profile,
               const coil::Properties& arguments) {
    const coil::Properties config = impl.settings();
    coil::Properties properties = inherited(config, profile);
    impl.listeners.rtclifecycle_.forEach([&](auto& listener) { listener.preConfigure(properties); });
    const std::string category(component.getCategory());
    const std::string name(component.getInstanceName());
    const auto folder = impl.conf_file.parent_path();
    configure_from(config, folder, category + "." + component.getTypeName(), properties);
    configure_from(config, folder, category + "." + name, properties);
    properties << arguments;
    for (const auto& key : arguments.propertyNames()) // ?gain=2 for the configuration parameter gain
        if (profile.findNode("conf.default." + key) != nullptr)
            properties.setProperty("conf.default." + key, arguments.getProperty(key));
    properties.setProperty("instance_name", name);
    component.setProperties(properties);
    coil::Properties& own = component.getProperties();
    own.setProperty("naming.names", format_name(own.getProperty("naming.formats"), own, config));
    impl.listeners.rtclifecycle_.forEach([&](auto& listener) { listener.postConfigure(properties); });
}

// Which name a component is to have: taken from here on, though it is not there yet.
class NameTaken {
  public:
    NameTaken(Manager::Impl& impl, std::string name) : impl_(impl), name_(std::move(name)) {
        std::lock_guard<std::recursive_mutex> lock(impl.mutex);
        const bool there =
            !impl.references([&](auto& one) { return name_ == one.getInstanceName(); }).empty();
        if (there || !impl.names_being_created.insert(name_).second)
            throw ManagerError("there is already a component " + name_);
    }
    ~NameTaken() {
        std::lock_guard<std::recursive_mutex> lock(impl_.mutex);
        impl_.names_being_created.erase(name_);
    }

  private:
    Manager::Impl& impl_;
    std::string name_;
};

// OpenRTM-aist starts other managers and passes such requests on to them.
void require_this_manager(const Manager::Impl& impl, const coil::Properties& arguments) {
    const std::string wanted = arguments.getProperty("manager_name");
    const std::string name = impl.setting("manager.instance_name");
    if (!wanted.empty() && wanted != name && wanted != impl.setting("manager.name"))
        throw ManagerError("manager_name is " + wanted + ", this manager is " + name +
                           " and has no others; ask that one");
    const std::string address = arguments.getProperty("manager_address");
    if (!address.empty()) throw ManagerError("manager_address is " + address + "; ask the manager there");
}

} // namespace

RTObject_impl& Manager::createOrThrow(const std::string& comp_args) {
    auto& listeners = m_impl->listeners.rtclifecycle_;
    std::string args = comp_args;
    listeners.forEach([&](auto& listener) { listener.preCreate(args); });
    const ComponentArguments wanted = parse_component_arguments(args);
    const std::string type = wanted.id.getProperty("implementation_id");
    require_this_manager(*m_impl, wanted.properties);

    // Not locked while the component's own code runs: it may ask the manager from threads of its own.
    std::shared_ptr<FactoryBase> factory;
    {
        std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
        factory = m_impl->find_factory(wanted.id);
    }
    if (factory == nullptr && loadForType(type)) {
        std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
        factory = m_impl->find_factory(wanted.id);
    }
    if (factory == nullptr)
        throw ManagerError("there is no component type " + type + " (known: " +
                           listed(getModulesFactories()) + "); name its library in manager.modules.preload");
    RTObject_impl& component = makeOrThrow(*factory);
    std::optional<NameTaken> taken;
    try {
        listeners.forEach([&](auto& listener) { listener.postCreate(&component); });
        const std::string name = wanted.properties.getProperty("instance_name", component.getInstanceName());
        taken.emplace(*m_impl, name);
        component.setInstanceName(name.c_str());
        configure(*m_impl, component, factory->profile(), wanted.properties);
        listeners.forEach([](auto& listener) { listener.preInitialize(); });
        if (component.initialize() != RTC_OK)
            throw ManagerError("component " + name + " does not start: its onInitialize has failed");
        listeners.forEach([](auto& listener) { listener.postInitialize(); });
    } catch (const ManagerError&) {
        m_impl->destroy_component(component.getInstanceName(), [&component, factory] {
            component.finalizePorts();
            component.finalizeContexts();
            factory->destroy(&component);
        });
        throw;
    }
    {
        std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
        m_impl->components.push_back({&component, factory});
        m_impl->ever_had_components = true;
    }
    registerComponent(&component);
    return component;
}

RTObject_impl* Manager::createComponent(const char* comp_args) {
    Logger& rtclog = m_impl->log;
    try {
        return &createOrThrow(comp_args);
    } catch (const ManagerError& e) {
        RTC_ERROR(("%s", e.what()));
        return nullptr;
    }
}

bool Manager::registerComponent(RTObject_impl* comp) {
    Logger& rtclog = m_impl->log;
    coil::vstring names = comp->getNamingNames();
    m_impl->listeners.naming_.forEach([&](auto& listener) { listener.preBind(comp, names); });
    RTObject_var ref = comp->getObjRef();
    bool all = true;
    for (const auto& name : names)
        for (const auto& refusal : m_impl->name_bindings->bind(name, ref.in())) {
            RTC_WARN(("%s", refusal.c_str()));
            all = false;
        }
    m_impl->listeners.naming_.forEach([&](auto& listener) { listener.postBind(comp, names); });
    return all;
}

bool Manager::unregisterComponent(RTObject_impl* comp) {
    coil::vstring names = comp->getNamingNames();
    m_impl->listeners.naming_.forEach([&](auto& listener) { listener.preUnbind(comp, names); });
    for (const auto& name : names) m_impl->name_bindings->unbind(name);
    m_impl->listeners.naming_.forEach([&](auto& listener) { listener.postUnbind(comp, names); });
    return true;
}

RTObject_impl* Manager::getComponent(const char* instance_name) {
    std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
    for (auto& component : m_impl->components)
        if (std::string(component.object->getInstanceName()) == instance_name) return component.object;
    return nullptr;
}

std::vector<RTObject_impl*> Manager::getComponents() {
    std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
    std::vector<RTObject_impl*> all;
    for (auto& component : m_impl->components) all.push_back(component.object);
    return all;
}

std::vector<RTObject_var> Manager::Impl::references(const std::function<bool(RTObject_impl&)>& fits) const {
    std::lock_guard<std::recursive_mutex> lock(mutex);
    std::vector<RTObject_var> all;
    for (const auto& component : components)
        if (fits(*component.object)) all.emplace_back(component.object->getObjRef());
    return all;
}

void Manager::deleteComponent(RTObject_impl* comp) {
    if (comp->exit() == RTC_OK) cleanupComponents();
}

void Manager::deleteComponent(const char* instance_name) {
    if (RTObject_impl* comp = getComponent(instance_name)) deleteComponent(comp);
}

void Manager::notifyFinalized(RTObject_impl* comp) {
    unregisterComponent(comp);
    std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
    auto found = std::find_if(m_impl->components.begin(), m_impl->components.end(),
                              [&](auto& entry) { return entry.object == comp; });
    if (found == m_impl->components.end()) return;
    m_impl->finalized.push_back(*found);
    m_impl->components.erase(found);
}

} // namespace RTC
