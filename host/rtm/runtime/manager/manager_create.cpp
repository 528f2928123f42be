// SPDX-License-Identifier: Apache-2.0
// Creation of components. OpenRTM-aist: Manager::createComponent(). The steps and the calls of listeners come
// in its order; an error is an exception here, with a line that says which step failed.
#include "host/crash/callback_scope.hpp"
#include "host/rtm/runtime/configuration/component_arguments.hpp"
#include "host/rtm/runtime/configuration/conf_check.hpp"
#include "host/rtm/runtime/configuration/conf_file.hpp"
#include "host/rtm/runtime/configuration/conf_keys.hpp"
#include "host/rtm/runtime/configuration/format_name.hpp"
#include "host/rtm/runtime/configuration/own_settings_check.hpp"
#include "host/rtm/runtime/manager/manager_impl.hpp"

#include <optional>
#include <rtm/RTObject.h>
#include <system_error>

namespace RTC {
namespace {

// The properties of a new component. OpenRTM-aist: Manager::configureComponent(), mergeProperty() and the list of
// inherited properties in Manager::createComponent().

// Applies the settings of rtc.conf that hold for every component. A setting that the user has made overrides the
// component's profile. A default of Tandem does not.
coil::Properties inherited_settings(const coil::Properties& config, const coil::Properties& profile) {
    coil::Properties out;
    auto inherit = [&](const std::string& key) {
        const std::string& value = config.getProperty(key);
        const bool is_default = value == config.getDefault(key);
        if (value.empty() || (is_default && !profile.getProperty(key).empty())) return;
        out.setProperty(key, value);
    };
    for (const char* key : {"config.version", "openrtm.name", "openrtm.version", "naming.formats"})
        inherit(key);
    for (const std::string section : {"exec_cxt", "ec", "port", "sdo.service"})
        if (const auto* node = config.findNode(section))
            for (const auto& key : node->propertyNames()) inherit(section + "." + key);
    return out;
}

// Adds the file CATEGORY.NAME.config_file, then the settings that rtc.conf has below CATEGORY.NAME. The file's
// path is relative to the working directory, then to the folder of rtc.conf.
void add_own_settings(const coil::Properties& config, const std::filesystem::path& folder,
                      const std::string& node_name, coil::Properties& out) {
    const auto* node = config.findNode(node_name);
    if (node == nullptr) return;
    const std::string file = node->getProperty("config_file");
    if (!file.empty()) {
        std::filesystem::path path(coil::replaceEnv(file));
        if (path.is_relative() && !std::filesystem::exists(path)) path = folder / path;
        if (std::filesystem::exists(path)) {
            read_conf_file(path, out);
        } else {
            // A warning only, as in OpenRTM-aist: rtc.conf is often passed on without the files it names.
            warn_about_setting("manager", node_name + ".config_file: file " + file +
                                              " does not exist; the component keeps its defaults");
        }
    }
    out << *node;
}

/// Gives a component that has its instance name, but is not initialized yet, its properties and names.
/// Precedence from low to high: `profile` of its type, what rtc.conf says for all components, the files and
/// settings of its type and of its instance, the arguments of its creation. Throws ManagerError for a
/// configuration file with an error. Returns the settings that are this component's own, from its files and arguments.
coil::Properties configure_component(Manager::Impl& impl, RTObject_impl& component,
                                     const coil::Properties& profile, const coil::Properties& arguments) {
    const coil::Properties config = impl.config_snapshot();
    coil::Properties properties = inherited_settings(config, profile);
    auto& listeners = impl.listeners.rtclifecycle_;
    listeners.forEach([&](auto& listener) { listener.preConfigure(properties); });
    const std::string category(component.getCategory());
    const std::string name(component.getInstanceName());
    const auto folder = impl.conf_file.parent_path();
    coil::Properties own_settings;
    add_own_settings(config, folder, category + "." + component.getTypeName(), own_settings);
    add_own_settings(config, folder, category + "." + name, own_settings);
    own_settings << arguments;
    const coil::Properties inherited = properties;
    properties << own_settings;
    for (const auto& key : own_settings.propertyNames()) // an empty value means that the key is not set
        if (own_settings.getProperty(key).empty() && find_conf_key(key) != nullptr)
            properties.setProperty(key, inherited.getProperty(key, profile.getProperty(key)));
    // `Name?gain=2` is short for `Name?conf.default.gain=2` when the type has a parameter gain.
    for (const auto& key : arguments.propertyNames())
        if (profile.findNode("conf.default." + key) != nullptr)
            properties.setProperty("conf.default." + key, arguments.getProperty(key));
    properties.setProperty("instance_name", name);
    component.setProperties(properties);
    coil::Properties& own = component.getProperties();
    own.setProperty("naming.names", format_name(own.getProperty("naming.formats"), own, config));
    listeners.forEach([&](auto& listener) { listener.postConfigure(properties); });
    return own_settings;
}

} // namespace

// Runs the component's constructor, which may throw anything.
RTObject_impl& Manager::makeOrThrow(FactoryBase& factory) {
    const std::string type = factory.profile().getProperty("implementation_id");
    const std::string failure = "component type " + type + " cannot be created";
    m_impl->begin_setup_step("the constructor of component type " + type);
    const tandem::crash::CallbackScope scope(nullptr, type.c_str(), "its constructor", nullptr);
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

// Reserves an instance name while the component of that name is created. If several callers ask for it at the same
// time, one gets it. Throws ManagerError if the name is in use.
class NameReservation {
  public:
    NameReservation(Manager::Impl& impl, std::string name) : impl_(impl), name_(std::move(name)) {
        std::lock_guard<std::recursive_mutex> lock(impl.mutex);
        const bool in_use =
            !impl.references([&](auto& component) { return name_ == component.getInstanceName(); }).empty();
        if (in_use || !impl.being_created.try_emplace(name_).second)
            throw ManagerError("there is already a component " + name_);
    }
    ~NameReservation() {
        std::lock_guard<std::recursive_mutex> lock(impl_.mutex);
        impl_.being_created.erase(name_);
    }
    /// The component is about to be deleted; the name stays reserved.
    void forget_component() {
        std::lock_guard<std::recursive_mutex> lock(impl_.mutex);
        impl_.being_created[name_].component = nullptr;
    }
    NameReservation(const NameReservation&) = delete;
    NameReservation& operator=(const NameReservation&) = delete;

  private:
    Manager::Impl& impl_;
    std::string name_;
};

// OpenRTM-aist passes requests for another manager on to a slave that it starts. Tandem has no slaves.
void require_this_manager(const Manager::Impl& impl, const coil::Properties& arguments) {
    const std::string requested = arguments.getProperty("manager_name");
    const std::string name = impl.setting("manager.instance_name");
    if (!requested.empty() && requested != name && requested != impl.setting("manager.name"))
        throw ManagerError("manager_name is " + requested + ", but this manager is " + name +
                           " and has no slaves; send the request to manager " + requested);
    const std::string address = arguments.getProperty("manager_address");
    if (!address.empty())
        throw ManagerError("manager_address is " + address + "; send the request to the manager there");
}

// Returns how the id of a loaded type of the requested name differs from the request, or an empty string if no type of
// that name is loaded.
std::string differences(const std::vector<coil::Properties>& loaded, const coil::Properties& requested) {
    const std::string type = requested.getProperty("implementation_id");
    std::string text;
    for (const auto& profile : loaded) {
        if (profile.getProperty("implementation_id") != type) continue;
        for (const char* key : {"vendor", "category", "version", "language"}) {
            const std::string wanted = requested.getProperty(key), present = profile.getProperty(key);
            if (!wanted.empty() && wanted != present)
                text +=
                    (text.empty() ? "" : ", ") + std::string(key) + " " + present + " instead of " + wanted;
        }
    }
    return text;
}

} // namespace

// If no loaded module has registered the type, loads the library that is named like the type.
std::shared_ptr<FactoryBase> Manager::Impl::require_factory(Manager& manager, const coil::Properties& id) {
    auto find = [&] {
        std::lock_guard<std::recursive_mutex> lock(mutex);
        return find_factory(id);
    };
    const std::string type = id.getProperty("implementation_id");
    auto factory = find();
    if (factory == nullptr && manager.loadForType(type)) factory = find();
    if (factory != nullptr) return factory;
    if (const auto other = differences(manager.getFactoryProfiles(), id); !other.empty())
        throw ManagerError("there is no component type " + type + " with this id: the loaded " + type +
                           " has " + other + "; correct the id, or load the library that has it");
    const auto known = manager.getModulesFactories();
    throw ManagerError("there is no component type " + type +
                       " (known: " + (known.empty() ? "none" : coil::flatten(known)) +
                       "); name its library in manager.modules.preload");
}

namespace {

// Throws ManagerError for a rate of a context that is not a number in range: a controller must not run at another rate.
void require_rates(const coil::Properties& settings, const std::string& name) {
    for (const auto& key : settings.propertyNames()) {
        const ConfKey* known = key.ends_with("rate") ? find_conf_key(key) : nullptr;
        std::string value = settings.getProperty(key);
        if (known != nullptr && known->value == ConfKey::hertz && !check_and_normalize_value(key, value))
            throw ManagerError("component " + name + " cannot be started: " + setting_error(key, value));
    }
}

} // namespace

// Names, configures and initializes a component that its factory has just made.
void Manager::Impl::set_up_component(RTObject_impl& component, const std::string& name, FactoryBase& factory,
                                     const coil::Properties& arguments) {
    auto& callbacks = listeners.rtclifecycle_;
    component.setInstanceName(name.c_str());
    const coil::Properties own_settings = configure_component(*this, component, factory.profile(), arguments);
    require_rates(component.getProperties(), name);
    begin_setup_step("onInitialize or onStartup of component " + name);
    const TransitionScope scope;
    begin_initialization(component, name);
    callbacks.forEach([](auto& listener) { listener.preInitialize(); });
    try {
        if (component.initialize() != RTC_OK)
            throw ManagerError("component " + name + " cannot be started: its onInitialize has failed");
    } catch (const std::system_error& e) {
        throw ManagerError("component " + name + " cannot be started: " + e.what());
    }
    callbacks.forEach([](auto& listener) { listener.postInitialize(); });
    for (const auto& line : check_own_settings(component, factory.profile(), own_settings))
        warn_about_setting(name, line);
}

// From here on tools can see that the component is being created, and a slow callback is logged.
void Manager::Impl::begin_initialization(RTObject_impl& component, const std::string& name) {
    std::lock_guard<std::recursive_mutex> lock(mutex);
    being_created[name] = {&component, component.getTypeName(), std::chrono::steady_clock::now()};
}

std::vector<ComponentCreation> Manager::Impl::creations() const {
    std::lock_guard<std::recursive_mutex> lock(mutex);
    std::vector<ComponentCreation> all;
    for (const auto& [name, creation] : being_created) {
        if (creation.component == nullptr) continue;
        const auto running = tandem::crash::find_running_callback(creation.component);
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - creation.since;
        all.push_back({name, creation.type, running ? running->name : "", taken.count()});
    }
    return all;
}

// Undoes the creation of a component that could not be set up.
void Manager::Impl::discard_component(RTObject_impl& component, std::shared_ptr<FactoryBase> factory) {
    run_destructors({{component.getInstanceName(), [&component, factory = std::move(factory)] {
                          component.finalizePorts();
                          component.finalizeContexts();
                          factory->destroy(&component);
                      }}});
}

// The mutex is not held while the component's code runs: that code may wait for another thread of the component that
// calls the manager.
RTObject_impl& Manager::createOrThrow(const std::string& comp_args) {
    auto& callbacks = m_impl->listeners.rtclifecycle_;
    std::string args = comp_args;
    callbacks.forEach([&](auto& listener) { listener.preCreate(args); });
    const ComponentArguments requested = parse_component_arguments(args);
    require_this_manager(*m_impl, requested.properties);
    const auto factory = m_impl->require_factory(*this, requested.id);
    RTObject_impl& component = makeOrThrow(*factory);
    std::optional<NameReservation> reservation; // until the component is listed, or destroyed
    try {
        callbacks.forEach([&](auto& listener) { listener.postCreate(&component); });
        const std::string name =
            requested.properties.getProperty("instance_name", component.getInstanceName());
        reservation.emplace(*m_impl, name);
        m_impl->set_up_component(component, name, *factory, requested.properties);
    } catch (const ManagerError&) {
        if (reservation) reservation->forget_component();
        m_impl->discard_component(component, factory);
        throw;
    }
    {
        std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
        m_impl->components.push_back({&component, factory});
        m_impl->ever_had_components = true;
        reservation.reset();
    }
    wake_main_loop(); // the main loop may have to end a manager that stays without components
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

} // namespace RTC
