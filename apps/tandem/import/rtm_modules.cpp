// SPDX-License-Identifier: Apache-2.0
// Finds the libraries of an OpenRTM-aist installation that rtm_host can load, and the sources of the others.
#include "apps/tandem/build/folder/source_text.hpp"
#include "apps/tandem/import/rtm_setup.hpp"
#include "apps/tandem/rtm/modules.hpp"

#include "host/plugin/abi.hpp"
#include "host/plugin/error.hpp"
#include "host/plugin/find_library.hpp"
#include "host/plugin/plugin_dirs.hpp"
#include "host/rtm/runtime/configuration/openrtm_modules.hpp"

#include <coil/stringutil.h>
#include <rtm/TandemAbi.h>

#include <algorithm>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

// An entry FILE(INIT_FUNCTION).
struct ModuleEntry {
    std::string file, function;
    explicit ModuleEntry(const std::string& entry)
        : file(coil::eraseBothEndsBlank(entry.substr(0, entry.find('(')))),
          function(entry.find('(') == std::string::npos ? "" : entry.substr(entry.find('('))) {}
    std::string init() const {
        return function.empty() ? "" : coil::eraseBothEndsBlank(function.substr(1, function.find(')') - 1));
    }
    // Returns the library's name without folder and without the suffix of Linux, Windows or macOS.
    std::string name() const {
        std::string name = fs::path(to_posix_path(file)).filename().string();
        for (const char* suffix : {".so", ".dll", ".DLL", ".dylib"})
            if (name.ends_with(suffix)) name.resize(name.size() - std::string(suffix).size());
        return name;
    }
    bool is_of_another_language() const {
        const auto suffix = fs::path(file).extension();
        return suffix == ".py" || suffix == ".pyc" || suffix == ".class" || suffix == ".jar" ||
               suffix == ".lua";
    }
};

bool has_sources(const fs::path& folder) {
    for (const auto& place : {folder, folder / "src"})
        for (const auto& file : list_files(place))
            if (is_source(file)) return true;
    return false;
}

// Returns the folder in the installation whose sources define the module. Checks folders with a matching name first.
// Limits the number of folders, so that the search is fast in a large folder such as a home directory.
fs::path find_sources(const fs::path& installation, const std::string& name) {
    constexpr int max_depth = 3, max_looked_into = 200;
    std::vector<fs::path> folders{installation};
    std::error_code ignored; // unreadable folders count as empty
    for (auto entry = fs::recursive_directory_iterator(
             installation, fs::directory_options::skip_permission_denied, ignored);
         entry != fs::recursive_directory_iterator(); entry.increment(ignored)) {
        if (!entry->is_directory(ignored)) continue;
        const std::string folder = entry->path().filename().string();
        if (entry.depth() >= max_depth || folder.starts_with(".") || folder == "build" || folder == "src")
            entry.disable_recursion_pending();
        if (!folder.starts_with(".") && folder != "build" && folder != "src")
            folders.push_back(entry->path());
        if (folders.size() > max_looked_into) break;
    }
    std::stable_partition(folders.begin(), folders.end(),
                          [&](const auto& folder) { return folder.filename().string().starts_with(name); });
    for (const auto& folder : folders) {
        if (!has_sources(folder)) continue;
        for (const auto& module : find_modules(folder))
            if (module.name == name) return folder;
    }
    return {};
}

// Throws plugin::Error unless the library exports the function that rtm_host calls, which need not use its argument.
void require_init(const fs::path& library, const plugin::LibraryContents& contents, const std::string& name,
                  const std::string& function) {
    const std::string plain = name.starts_with("lib") ? name.substr(3) : name;
    for (const auto& each : function.empty()
                                ? std::vector<std::string>{name + "Init", plain + "Init", "rtc_init"}
                                : std::vector<std::string>{function})
        if (contents.exports.contains(each)) return;
    if (contents.kind != plugin::LibraryKind::rtc_module && contents.kind != plugin::LibraryKind::other)
        plugin::require_kind(library, contents, plugin::LibraryKind::rtc_module);
    throw plugin::Error(plugin::Reason::wrong_model,
                        "library " + library.string() + " exports no function " +
                            (function.empty() ? name + "Init" : function) + " (extern \"C\")" +
                            (contents.entry.empty() ? "" : ", only " + contents.entry));
}

void add_build_task(const RtmSetup& setup, const std::string& name, const std::string& why,
                    const fs::path& sources, const std::string& origin, ImportReport& report) {
    report.add_task(origin, "module " + name + ": " + why,
                    "tandem rtm build " + (sources.empty() ? "FOLDER_OF_ITS_SOURCE" : sources.string()) +
                        " --output " + setup.output.string());
}

} // namespace

ModuleSource find_module(const RtmSetup& setup, const std::string& name, const std::string& function) {
    ModuleSource found;
    auto folders = setup.load_path;
    folders.push_back(setup.installation);
    const auto defaults = plugin::default_plugin_dirs("rtm");
    folders.insert(folders.end(), defaults.begin(), defaults.end());
    try {
        const auto library = plugin::find_library(name, folders);
        const auto contents = plugin::read_contents(library);
        require_init(library, contents, name, function);
        plugin::require_abi(library, contents, plugin::ComponentModel::rtm, TANDEM_RTM_ABI);
        found.library = library;
        return found;
    } catch (const plugin::Error& error) {
        if (error.reason() == plugin::Reason::abi_mismatch)
            found.unusable = "its library was built for another manager";
        else if (error.reason() != plugin::Reason::not_found)
            found.unusable = error.what();
    }
    found.folder = find_sources(setup.installation, name);
    return found;
}

void add_module(RtmSetup& setup, const std::string& name, const std::string& origin, ImportReport& report,
                const std::string& function) {
    const auto found = find_module(setup, name, function);
    if (found.library.empty())
        add_build_task(setup, name, found.unusable.empty() ? "its library was not found" : found.unusable,
                       found.folder, origin, report);
    else if (std::find(setup.load_path.begin(), setup.load_path.end(), found.library.parent_path()) ==
                 setup.load_path.end() &&
             found.library.parent_path() == setup.installation)
        setup.load_path.push_back(setup.installation);
    setup.modules.push_back(name + ".so");
}

// Which interface types a library brings is known only when it runs.
bool has_interface_type(const RtmSetup& setup, const std::string& type) {
    for (const char* own : {"corba_cdr", "data_service", "direct", "shared_memory"})
        if (type == own) return true;
    return std::any_of(setup.modules.begin(), setup.modules.end(), [&](const std::string& text) {
        const ModuleEntry entry(text);
        if (entry.is_of_another_language() || RTC::find_openrtm_module(entry.name()) != nullptr) return false;
        const auto library = find_module(setup, entry.name(), entry.init()).library;
        return !library.empty() && plugin::read_contents(library).is_transport;
    });
}

void check_modules(RtmSetup& setup, ImportReport& report) {
    const std::string origin = setup.modules_origin;
    auto entries = std::move(setup.modules);
    setup.modules.clear();
    for (const auto& text : entries) {
        const ModuleEntry entry(text);
        const std::string name = entry.name();
        if (entry.is_of_another_language()) {
            report.add_difference(origin, "preload " + text, "left out: rtm_host loads only C++ modules");
            continue;
        }
        const auto* known = RTC::find_openrtm_module(name);
        if (known != nullptr && find_module(setup, name).library.empty()) {
            report.add_difference(origin, "preload " + text, "left out: " + known->instead);
            continue;
        }
        // The manager finds libraries in the folders of the load path by file name only.
        if (const fs::path parent = fs::path(to_posix_path(entry.file)).parent_path(); !parent.empty())
            if (const auto folder = setup.resolve(parent.string()); !folder.empty())
                setup.load_path.push_back(folder);
        add_module(setup, name, origin, report, entry.init());
        setup.modules.back() += entry.function;
    }
}

} // namespace tandem::command
