// SPDX-License-Identifier: Apache-2.0
// Which libraries of components there are, and letting go of them.
#include "host/plugin/abi.hpp"
#include "host/plugin/error.hpp"
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include <algorithm>
#include <dlfcn.h>
#include <rtm/RTObject.h>
#include <rtm/TandemAbi.h>

namespace RTC {
namespace {

coil::Properties profile_of(const std::string& name, const std::filesystem::path& file) {
    coil::Properties profile;
    profile.setProperty("module_file_name", name);
    profile.setProperty("module_file_path", file.string());
    profile.setProperty("language", "C++");
    return profile;
}

bool is_module(const std::filesystem::path& file) {
    try {
        const auto contents = tandem::plugin::read_contents(file);
        tandem::plugin::require_abi(file, contents, tandem::plugin::Model::rtm, TANDEM_RTM_ABI);
        return contents.kind == tandem::plugin::Kind::rtc_module;
    } catch (const tandem::plugin::Error&) {
        return false; // no library, or none for this processor or host
    }
}

// Its code is part of the library.
bool comes_from(const FactoryBase& factory, const std::filesystem::path& library) {
    const auto* made_by = dynamic_cast<const FactoryCXX*>(&factory);
    Dl_info info{};
    std::error_code none;
    return made_by != nullptr && dladdr(reinterpret_cast<void*>(made_by->creator()), &info) != 0 &&
           std::filesystem::equivalent(info.dli_fname, library, none);
}

} // namespace

std::vector<coil::Properties> Manager::getLoadedModules() {
    std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
    std::vector<coil::Properties> modules;
    for (auto& module : m_impl->modules) modules.push_back(profile_of(module.name, module.library->path()));
    return modules;
}

// By what is in the files: none is loaded to ask it.
std::vector<coil::Properties> Manager::getLoadableModules() {
    std::vector<coil::Properties> modules;
    for (const auto& folder : m_impl->module_dirs()) {
        std::error_code none;
        for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
            const auto& file = entry.path();
            if (file.extension() == ".so" && entry.is_regular_file(none) && is_module(file))
                modules.push_back(
                    profile_of(file.filename().string(), std::filesystem::absolute(file, none)));
        }
    }
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

ReturnCode_t Manager::unload(const char* file_name) {
    const std::string wanted(file_name);
    std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
    auto& modules = m_impl->modules;
    const auto module = std::find_if(modules.begin(), modules.end(), [&](const auto& one) {
        const auto& path = one.library->path();
        return wanted == one.name || wanted == path.string() || wanted == path.filename().string();
    });
    if (module == modules.end()) return BAD_PARAMETER;
    const auto path = module->library->path();
    auto uses = [&](const auto& all) {
        return std::any_of(all.begin(), all.end(),
                           [&](const auto& one) { return comes_from(*one.factory, path); });
    };
    if (uses(m_impl->components) || uses(m_impl->finalized)) return PRECONDITION_NOT_MET;
    std::erase_if(m_impl->factories, [&](const auto& factory) { return comes_from(*factory, path); });
    modules.erase(module);
    return RTC_OK;
}

void Manager::unloadAll() {
    for (const auto& module : getLoadedModules()) unload(module.getProperty("module_file_path").c_str());
}

} // namespace RTC
