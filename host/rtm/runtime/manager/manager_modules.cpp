// SPDX-License-Identifier: Apache-2.0
// Loading modules (libraries of components) and the component and context types that they register.
// OpenRTM-aist: Manager::load(), registerFactory(), registerECFactory() and class ModuleManager.
#include "host/plugin/abi.hpp"
#include "host/plugin/find_library.hpp"
#include "host/rtm/runtime/configuration/openrtm_modules.hpp"
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include <rtm/RTObject.h>
#include <rtm/TandemAbi.h>

namespace RTC {

std::vector<std::filesystem::path> Manager::Impl::module_dirs() const {
    std::vector<std::filesystem::path> dirs;
    for (const char* key : {"manager.modules.C++.load_paths", "manager.modules.load_path"})
        for (const auto& dir : coil::split(setting(key), ",", true)) {
            dirs.emplace_back(coil::replaceEnv(dir));
            // The folder of rtc.conf comes second, so that a configuration can be moved with its modules.
            if (!conf_file.empty() && dirs.back().is_relative())
                dirs.push_back(conf_file.parent_path() / dirs.back());
        }
    dirs.insert(dirs.end(), options.plugin_path.begin(), options.plugin_path.end());
    return dirs;
}

namespace {

// /a/libName.so -> libName
std::string base_name(const std::string& file_name) {
    std::string name = std::filesystem::path(file_name).filename().string();
    return name.substr(0, name.find('.'));
}

// The name of the init function when rtc.conf does not give it: NAMEInit with or without a leading `lib` in NAME, or rtc_init,
// as in components of old templates.
std::string find_init_symbol(const std::filesystem::path& file,
                             const tandem::plugin::LibraryContents& contents, const std::string& base) {
    std::vector<std::string> tried{base + "Init"};
    if (base.compare(0, 3, "lib") == 0) tried.push_back(base.substr(3) + "Init");
    tried.emplace_back("rtc_init");
    for (const auto& symbol : tried)
        if (contents.exports.count(symbol)) return symbol;
    // A library of another model gets the message that says so.
    if (contents.kind != tandem::plugin::LibraryKind::rtc_module &&
        contents.kind != tandem::plugin::LibraryKind::other)
        tandem::plugin::require_kind(file, contents, tandem::plugin::LibraryKind::rtc_module);
    throw ManagerError("module " + file.string() + " has no function " + tried[0] +
                       "; export it (extern \"C\"), or name another function: " + file.filename().string() +
                       "(FUNCTION)");
}

void warn_of_undefined(const tandem::plugin::Library& library, Logger& rtclog) {
    if (!library.undefined().empty())
        RTC_WARN(("module %s; the module is loaded, but a call of this function will end the host: add the "
                  "library or source that defines it to the module's build",
                  library.undefined().c_str()));
}

// Runs the module's init function, which may throw anything.
void call_init(const std::function<void()>& init, const std::string& what) {
    try {
        init();
    } catch (const std::exception& e) {
        throw ManagerError(what + " threw an exception: " + e.what());
    } catch (const CORBA::Exception& e) {
        throw ManagerError(what + " threw the CORBA exception " + e._name());
    } catch (...) {
        throw ManagerError(what + " threw an exception of unknown type");
    }
}

} // namespace

Manager::Impl::ModuleFile Manager::Impl::find_module(const std::string& name,
                                                     const std::string& init_function) const {
    namespace plugin = tandem::plugin;
    if (std::filesystem::path(name).is_absolute() &&
        !coil::toBool(setting("manager.modules.abs_path_allowed"), "YES", "NO", true))
        throw ManagerError("module " + name +
                           ": absolute paths are not allowed (manager.modules.abs_path_allowed: NO)");
    const auto file = plugin::find_library(name, module_dirs());
    const auto contents = plugin::read_contents(file);
    plugin::require_abi(file, contents, plugin::ComponentModel::rtm, TANDEM_RTM_ABI);
    return {file, init_function.empty() ? find_init_symbol(file, contents, base_name(name)) : init_function,
            contents.trusted};
}

// Checks before it loads, since loading runs the library's static constructors: first what can be read from
// the file, then, if the host wants it, a trial in a child process.
void Manager::loadOrThrow(const std::string& file_name, const std::string& init_function) {
    std::string name = file_name, function = init_function;
    m_impl->listeners.module_.forEach([&](auto& listener) { listener.preLoad(name, function); });
    try {
        namespace plugin = tandem::plugin;
        const auto [file, symbol, trusted] = m_impl->find_module(name, function);
        if (m_impl->probes && !trusted) m_impl->probes->finish(file, symbol, m_impl->log);
        const auto library = plugin::Library::load(file, plugin::UndefinedFunctions::accept);
        warn_of_undefined(*library, m_impl->log);
        plugin::require_abi_of_process(plugin::ComponentModel::rtm, TANDEM_RTM_ABI, library->path());
        const auto init = library->symbol<void(Manager*)>(symbol);
        {
            // Never unloaded: objects and code of a component may be in use until the process ends.
            std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
            m_impl->libraries.insert(library);
            std::erase_if(m_impl->modules,
                          [&](auto& module) { return module.library->path() == library->path(); });
            m_impl->modules.push_back({name, library});
        }
        call_init([&] { init(this); }, symbol + "() of module " + file.string());
    } catch (const tandem::plugin::Error& e) {
        const OpenRtmModule* known =
            find_openrtm_module(name); // a module of that name that was built for Tandem has been loaded
        if (known == nullptr) throw ManagerError(e.what());
        if (!known->can_be_left_out)
            throw ManagerError("module " + name + " of OpenRTM-aist is not available here; " +
                               known->instead);
        Logger& rtclog = m_impl->log;
        RTC_INFO(("module %s of OpenRTM-aist is passed over: %s", name.c_str(), known->instead.c_str()));
        return;
    }
    m_impl->listeners.module_.forEach([&](auto& listener) { listener.postLoad(name, function); });
}

bool Manager::loadForType(const std::string& type) {
    if (!coil::toBool(m_impl->setting("manager.modules.search_auto"), "YES", "NO", true)) return false;
    if (type.find('/') != std::string::npos) return false; // a type; only load() accepts a path
    try {
        tandem::plugin::find_library(type, m_impl->module_dirs());
    } catch (const tandem::plugin::Error&) {
        return false; // the caller reports the missing type instead, which the user asked for
    }
    loadOrThrow(type, "");
    return true;
}

ReturnCode_t Manager::load(const std::string& file_name, const std::string& init_function) {
    Logger& rtclog = m_impl->log;
    try {
        loadOrThrow(file_name, init_function);
        return RTC_OK;
    } catch (const ManagerError& e) {
        RTC_ERROR(("%s", e.what()));
        return RTC_ERROR;
    }
}

// Returns false if a type with the same id is already registered, for example by another module.
bool Manager::registerFactory(coil::Properties& profile, RtcNewFunc new_func, RtcDeleteFunc delete_func) {
    std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
    coil::Properties id;
    for (const char* key : {"implementation_id", "vendor", "category", "version", "language"})
        id.setProperty(key, profile.getProperty(key));
    if (m_impl->find_factory(id) != nullptr) return false;
    m_impl->factories.push_back(std::make_shared<FactoryCXX>(profile, new_func, delete_func));
    return true;
}

std::shared_ptr<FactoryBase> Manager::Impl::find_factory(const coil::Properties& id) {
    for (const auto& factory : factories) {
        bool matches = true;
        for (const char* key : {"implementation_id", "vendor", "category", "version", "language"}) {
            const std::string required = id.getProperty(key);
            matches = matches && (required.empty() || required == factory->profile().getProperty(key));
        }
        if (matches) return factory;
    }
    return nullptr;
}

std::vector<coil::Properties> Manager::getFactoryProfiles() {
    std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
    std::vector<coil::Properties> profiles;
    for (auto& factory : m_impl->factories) profiles.push_back(factory->profile());
    return profiles;
}

std::vector<std::string> Manager::getModulesFactories() {
    std::vector<std::string> names;
    for (auto& profile : getFactoryProfiles()) names.push_back(profile.getProperty("implementation_id"));
    return names;
}

bool Manager::registerECFactory(const char* name, ECNewFunc new_func, ECDeleteFunc delete_func) {
    std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
    return m_impl->contexts.emplace(name, Impl::ContextType{new_func, delete_func}).second;
}

// `TYPE` or `TYPE?key=value...`; the properties are those of init(), which the caller calls.
ExecutionContextBase* Manager::createContext(const char* ec_args) {
    const std::string args(ec_args);
    // In lock-step mode no context may have a thread, even if a component requests another type. Only Manager::step() runs
    // its cycles.
    const std::string type = m_impl->options.lockstep ? "SynchExtTriggerEC" : args.substr(0, args.find('?'));
    std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
    auto found = m_impl->contexts.find(type);
    if (found != m_impl->contexts.end()) return found->second.create();
    return ExecutionContextFactory::instance().createObject(type); // NULL: unknown type
}

} // namespace RTC
