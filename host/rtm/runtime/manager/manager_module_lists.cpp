// SPDX-License-Identifier: Apache-2.0
// Lists of loaded and loadable modules, and unloading. OpenRTM-aist: Manager::getLoadedModules(),
// getLoadableModules(), unload() and class ModuleManager. There a module is loaded into a helper process to
// learn its profile, and unloading takes its code out of the process; neither is done here (DIFFERENCES.md).
#include "host/plugin/abi.hpp"
#include "host/plugin/error.hpp"
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include <algorithm>
#include <dlfcn.h>
#include <rtm/RTObject.h>
#include <rtm/TandemAbi.h>

namespace RTC {
namespace {

coil::Properties module_profile(const std::string& name, const std::filesystem::path& file) {
    coil::Properties profile;
    profile.setProperty("module_file_name", name);
    profile.setProperty("module_file_path", file.string());
    profile.setProperty("language", "C++");
    return profile;
}

// Decided by the symbols and notes in the file, without running any of its code.
bool is_loadable_rtc_module(const std::filesystem::path& file) {
    try {
        const auto contents = tandem::plugin::read_contents(file);
        tandem::plugin::require_abi(file, contents, tandem::plugin::ComponentModel::rtm, TANDEM_RTM_ABI);
        return contents.kind == tandem::plugin::LibraryKind::rtc_module;
    } catch (const tandem::plugin::Error&) {
        return false; // not a library, or for another processor, or built against other headers
    }
}

// Returns whether the function that creates this factory's components is part of the library.
bool is_defined_in(const FactoryBase& factory, const std::filesystem::path& library) {
    const auto* with_function = dynamic_cast<const FactoryCXX*>(&factory);
    Dl_info info{};
    std::error_code ignored;
    return with_function != nullptr &&
           dladdr(reinterpret_cast<void*>(with_function->creator()), &info) != 0 &&
           std::filesystem::equivalent(info.dli_fname, library, ignored);
}

} // namespace

std::vector<coil::Properties> Manager::getLoadedModules() {
    std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
    std::vector<coil::Properties> modules;
    for (auto& module : m_impl->modules) {
        modules.push_back(module_profile(module.name, module.library->path()));
        // OpenRTM-aist gives loaded modules this key, and loadable ones module_file_path. Tools of both kinds exist.
        modules.back().setProperty("file_path", module.library->path().string());
    }
    return modules;
}

std::vector<coil::Properties> Manager::getLoadableModules() {
    std::vector<coil::Properties> modules;
    for (const auto& folder : m_impl->module_dirs()) {
        std::error_code ignored;
        for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
            const auto& file = entry.path();
            if (file.extension() == ".so" && entry.is_regular_file(ignored) && is_loadable_rtc_module(file))
                modules.push_back(
                    module_profile(file.filename().string(), std::filesystem::absolute(file, ignored)));
        }
    }
    // A folder may be listed twice, by its relative and its absolute path.
    std::sort(modules.begin(), modules.end(), [](const auto& a, const auto& b) {
        return a.getProperty("module_file_path") < b.getProperty("module_file_path");
    });
    modules.erase(std::unique(modules.begin(), modules.end(),
                              [](const auto& a, const auto& b) {
                                  return a.getProperty("module_file_path") ==
                                         b.getProperty("module_file_path");
                              }),
                  modules.end());
    return modules;
}

// Accepts the name that was given to load(), the path or the file name. Components that have exited but are
// not deleted yet still use the module's code for their destructors.
ReturnCode_t Manager::unload(const char* file_name) {
    const std::string requested(file_name);
    std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
    auto& modules = m_impl->modules;
    const auto module = std::find_if(modules.begin(), modules.end(), [&](const auto& loaded) {
        const auto& path = loaded.library->path();
        return requested == loaded.name || requested == path.string() ||
               requested == path.filename().string();
    });
    if (module == modules.end()) return BAD_PARAMETER;
    const auto path = module->library->path();
    auto uses = [&](const auto& all) {
        return std::any_of(all.begin(), all.end(),
                           [&](const auto& component) { return is_defined_in(*component.factory, path); });
    };
    if (uses(m_impl->components) || uses(m_impl->finalized)) return PRECONDITION_NOT_MET;
    std::erase_if(m_impl->factories, [&](const auto& factory) { return is_defined_in(*factory, path); });
    modules.erase(module);
    return RTC_OK;
}

void Manager::unloadAll() {
    for (const auto& module : getLoadedModules()) unload(module.getProperty("module_file_path").c_str());
}

} // namespace RTC
