// SPDX-License-Identifier: Apache-2.0
// tandem opros import: turns an installation of the OPRoS engine into DIR/opros for tandem run.
#include "apps/tandem/build/folder/source_text.hpp"
#include "apps/tandem/import/commands.hpp"
#include "apps/tandem/import/engine_config.hpp"
#include "apps/tandem/import/import_folder.hpp"
#include "apps/tandem/import/import_nodes.hpp"
#include "apps/tandem/output/print.hpp"
#include "host/opros/engine/load/load_component.hpp"
#include "host/opros/engine/profile/application_profile.hpp"
#include "host/opros/engine/profile/flatten_composites.hpp"
#include "host/opros/engine/profile/profile_kind.hpp"
#include "host/opros/engine/profile/xml_file.hpp"
#include "host/plugin/error.hpp"
#include "host/plugin/find_library.hpp"
#include "host/plugin/plugin_dirs.hpp"
#include "shm/segment/segment_file.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

namespace tandem::command {
namespace {

struct ComponentPlaces {
    std::filesystem::path engine_dir;
    const engine::ApplicationProfile& application; ///< in the installation
    std::map<std::filesystem::path, std::filesystem::path>
        folders; ///< new path to original path of each copied folder
};

namespace fs = std::filesystem;
using engine::XmlFile;

bool is_periodic(const engine::ComponentProfile& profile) {
    return profile.execution_type == engine::ExecutionType::periodic ||
           profile.execution_type == engine::ExecutionType::periodic_shared;
}

void tell_execution(const XmlFile& xml, const engine::ComponentProfile& profile, ImportReport& report) {
    const auto semantics = xml.root().child("execution_semantics");
    const auto differs = [&](const pugi::xml_node& node, const std::string& what, const char* here) {
        report.add_difference(xml.location(node).text(), profile.name + ": " + what, here);
    };
    if (profile.execution_type == engine::ExecutionType::aperiodic)
        differs(semantics.child("type"), "execution type " + XmlFile::child_text(semantics, "type"),
                "runs when an input has arrived, not continuously; for the engine's behaviour, use "
                "aperiodic-loop");
    if (is_periodic(profile) && profile.scheduling_policy == engine::SchedulingPolicy::other)
        differs(semantics.child("type"), "a periodic component",
                "has no real-time priority, which the engine, as root, would set; to use <priority>, set "
                "<policy>SCHED_FIFO</policy>");
}

void tell_queues(const engine::ComponentProfile& profile, ImportReport& report) {
    for (const auto& port : profile.data_ports)
        if (port.queue)
            report.add_difference(
                port.location.text(),
                profile.name + ": queue of port " + port.name + " for " + std::to_string(port.queue->size) +
                    " values",
                "takes effect if the component's code sets no queue for the port; the engine ignores it");
    for (const auto& error : profile.port_errors)
        report.add_difference(profile.location.text(), profile.name, error);
}

bool has_component_source(const fs::path& folder) {
    for (const auto& place : {folder, folder / "src"})
        for (const auto& file : list_files(place))
            if (is_source(file) && defines_function(strip_comments(read_text(file)), "getComponent"))
                return true;
    return false;
}

// Returns a folder of sources in the installation whose name begins with the component's name.
fs::path find_component_sources(const fs::path& engine_dir, const std::string& name) {
    constexpr int max_depth = 4, max_seen = 5000;
    int seen = 0;
    std::error_code ignored; // unreadable folders count as empty
    for (auto entry = fs::recursive_directory_iterator(
             engine_dir, fs::directory_options::skip_permission_denied, ignored);
         entry != fs::recursive_directory_iterator() && ++seen < max_seen; entry.increment(ignored)) {
        if (entry.depth() >= max_depth) entry.disable_recursion_pending();
        if (entry->is_directory(ignored) && entry->path().filename().string().starts_with(name) &&
            has_component_source(entry->path()))
            return entry->path();
    }
    return {};
}

// Returns the original of a copied folder, or of a folder in it.
fs::path old_place(const fs::path& folder, const ComponentPlaces& places) {
    for (const auto& [copy, original] : places.folders)
        if (const fs::path below = folder.lexically_relative(copy); !below.empty() && *below.begin() != "..")
            return (original / below).lexically_normal();
    return folder;
}

// Returns the library in the installation if opros_host can load it; otherwise sets `why` to the reason.
fs::path find_usable_library(const engine::ComponentProfile& profile, const ComponentPlaces& places,
                             const fs::path& old_folder, std::string& why) {
    std::vector<fs::path> folders{old_folder, places.application.location.file.parent_path()};
    try {
        fs::path library = plugin::find_library(profile.library_name, folders);
        engine::require_opros_component(library);
        return library;
    } catch (const plugin::Error& error) {
        why = error.reason() == plugin::Reason::not_found      ? "its library was not found"
              : error.reason() == plugin::Reason::abi_mismatch ? "its library was built for another engine"
                                                               : error.what();
        return {};
    }
}

void import_library(const engine::ComponentProfile& profile, const ComponentPlaces& places,
                    ImportReport& report) {
    const fs::path folder = profile.location.file.parent_path();
    std::string why;
    const fs::path library = find_usable_library(profile, places, old_place(folder, places), why);
    if (!library.empty()) {
        fs::copy_file(library, folder / library.filename(), fs::copy_options::skip_existing);
        return;
    }
    const fs::path sources = find_component_sources(places.engine_dir, profile.name);
    report.add_task(profile.library_location.text(), "component " + profile.name + ": " + why,
                    "tandem opros build " + (sources.empty() ? "FOLDER_OF_ITS_SOURCE" : sources.string()) +
                        " --profile " + profile.location.file.string());
}

/// Reports differences in the application profile itself: properties, connections.
void tell_application_differences(const engine::ApplicationProfile& application, ImportReport& report) {
    const XmlFile xml(application.location.file);
    for (const auto& node : xml.root().child("subcomponents").children("subcomponent"))
        if (node.child("properties"))
            report.add_difference(
                xml.location(node.child("properties")).text(),
                XmlFile::child_text(node, "name") + ": properties",
                "override the properties of the component profile; the engine ignores them");
    for (const auto& connection : application.connections)
        if (!connection.error.empty())
            report.add_difference(connection.location.text(),
                                  connection.source.text() + " to " + connection.target.text(),
                                  "left out with a message: " + connection.error);
    report.add_difference(application.location.file.string(), "a component that fails",
                          "loses its connections, and the others run; the engine refuses the application, as "
                          "tandem run --strict does");
}

/// Copies the component's library beside its profile if opros_host can load it; otherwise adds the task to build it.
/// Reports differences in the profile. Throws engine::SetupError if the profile is not well-formed.
void import_component(const engine::Subcomponent& component, const ComponentPlaces& places,
                      ImportReport& report) {
    const XmlFile xml(component.file);
    engine::ComponentProfile profile;
    try {
        profile = engine::read_component_profile(xml);
    } catch (
        const engine::SetupError&
            error) { // the engine accepts some invalid profiles, such as a periodic component without a period
        return report.add_task("", error.what(), "edit the profile");
    }
    import_library(profile, places, report);
    tell_execution(xml, profile, report);
    tell_queues(profile, report);
    auto folders = plugin::default_plugin_dirs("opros");
    for (const auto& line : engine::check_properties(profile, component, folders))
        report.add_task("", line, "");
}

namespace fs = std::filesystem;
using engine::XmlFile;

bool is_library(const fs::path& file) {
    const std::string name = file.filename().string();
    for (const char* suffix : {".so", ".dll", ".dylib", ".lib", ".exe", ".a", ".o"})
        if (name.ends_with(suffix)) return true;
    return name.find(".so.") != std::string::npos;
}

/// Copies the application's files to the new folder. Skips libraries that opros_host cannot load.
class ApplicationCopy {
  public:
    ApplicationCopy(const engine::ApplicationProfile& application, const ImportNodes& nodes,
                    const fs::path& output, ImportReport& report)
        : application_(application), nodes_(nodes), from_(application.location.file.parent_path()),
          output_(output), report_(report) {}

    void copy_components() {
        for (const auto& component : application_.subcomponents) {
            if (nodes_.is_elsewhere(component)) continue;
            // Components of Tandem, such as AdaptorComp, are not copied: the host finds them.
            const fs::path file =
                engine::find_component_profile(application_, component, plugin::default_plugin_dirs("opros"));
            if (is_ours(file)) continue;
            const fs::path folder =
                file.parent_path().lexically_normal().lexically_relative(from_.lexically_normal());
            if (folder == ".") {
                copy_profiles_beside(file);
            } else if (folder.empty() || *folder.begin() == "..") {
                if (component.name.find('/') != std::string::npos || component.name.starts_with("."))
                    throw engine::SetupError(
                        component.location,
                        "name '" + component.name +
                            "' cannot be used as a folder name: expected no '/' and no leading '.'");
                copy_folder(file.parent_path(), output_ / component.name);
                moved_[component.name] = file.filename().string();
            } else {
                copy_folder(file.parent_path(), output_ / folder);
            }
        }
    }

    const std::map<fs::path, fs::path>& folders() const { return folders_; }

    /// Writes the application profile, with an AdaptorComp if `link` is not empty; copies it if nothing
    /// changes.
    void write_application(const std::string& link) {
        const fs::path file = application_.location.file, target = output_ / file.filename();
        if (link.empty() && moved_.empty() && !nodes_.has_elsewhere()) {
            fs::copy_file(file, target);
        } else {
            save(file, target, link);
        }
        report_.add_file(target);
    }

  private:
    static bool is_ours(const fs::path& file) {
        for (const auto& folder : plugin::default_plugin_dirs("opros"))
            if (file.parent_path() == folder) return true;
        return false;
    }

    void copy_file(const fs::path& file, const fs::path& target) {
        if (is_library(file) || !copied_.insert(target).second) return;
        if (copied_.size() > max_files)
            throw std::runtime_error(
                from_.string() + " has more than " + std::to_string(max_files) +
                " files beside its profiles: move the application to a folder without other files");
        fs::create_directories(target.parent_path());
        fs::copy_file(file, target);
        fs::permissions(target, fs::perms::owner_write, fs::perm_options::add);
    }

    void copy_folder(const fs::path& folder, const fs::path& target) {
        folders_[target] = folder;
        for (const auto& entry : fs::recursive_directory_iterator(folder))
            if (entry.is_regular_file())
                copy_file(entry.path(), target / entry.path().lexically_relative(folder));
    }

    // If several components and the application share one folder, copies only the component's own profile, type
    // profiles, and res/.
    void copy_profiles_beside(const fs::path& file) {
        folders_[output_] = from_;
        copy_file(file, output_ / file.filename());
        for (const auto& each : list_entries(from_, ".xml"))
            if (const auto kind = engine::find_profile_kind(each);
                kind == engine::ProfileKind::service_type || kind == engine::ProfileKind::data_type)
                copy_file(each, output_ / each.filename());
        if (fs::is_directory(from_ / "res")) copy_folder(from_ / "res", output_ / "res");
    }

    void save(const fs::path& file, const fs::path& target, const std::string& link) {
        const XmlFile xml(file);
        pugi::xml_document document;
        auto declaration = document.append_child(pugi::node_declaration);
        declaration.append_attribute("version") = "1.0";
        declaration.append_attribute("encoding") = "UTF-8";
        auto root = document.append_copy(xml.root());
        auto list = root.child("subcomponents");
        for (auto component : list.children("subcomponent"))
            if (const auto moved = moved_.find(XmlFile::child_text(component, "name")); moved != moved_.end())
                component.child("reference").text().set(moved->second.c_str());
        nodes_.write(root);
        if (!link.empty()) {
            auto adaptor = list.append_child("subcomponent");
            adaptor.append_child("name").text().set("Adaptor");
            adaptor.append_child("reference").text().set("AdaptorComp.xml");
            auto property = adaptor.append_child("properties").append_child("property");
            property.append_attribute("name") = "link";
            property.text().set(link.c_str());
        }
        std::ostringstream text;
        document.save(text, "  ");
        write_file(target, text.str());
    }

    static constexpr std::size_t max_files = 10000;
    const engine::ApplicationProfile& application_;
    const ImportNodes& nodes_;
    fs::path from_, output_;
    ImportReport& report_;
    std::map<std::string, std::string> moved_; // components whose folder moved, with their new reference
    std::map<fs::path, fs::path> folders_;     // copied folders: new path to old path
    std::set<fs::path> copied_;
};

struct Import {
    const fs::path& engine_dir;
    const EngineConfig& config;
    const engine::ApplicationProfile& application;
    const std::string& link;
};

/// Writes the application and its components to the new folder.
void write_import(const Import& import, const fs::path& folder, ImportReport& report) {
    const auto& application = import.application;
    const ImportNodes nodes(application, import.config);
    ApplicationCopy copy(application, nodes, folder, report);
    copy.copy_components();
    copy.write_application(import.link);
    // From here on, reports name files in the new folder, because users edit those.
    tell_application_differences(application, report);
    const auto written = engine::read_application_profile(folder / application.location.file.filename());
    nodes.report(written, report);
    const ComponentPlaces places{import.engine_dir, application, copy.folders()};
    for (const auto& component :
         engine::flatten_composites(written, plugin::default_plugin_dirs("opros")).subcomponents)
        if (!nodes.is_elsewhere(component) && component.file.string().starts_with(folder.string()))
            import_component(component, places, report);
}

} // namespace

int opros_import(const OprosImportOptions& options) {
    if (!fs::is_directory(options.folder))
        throw std::runtime_error(options.folder.string() +
                                 " is not a folder: expected an installation of the OPRoS engine");
    if (!options.link.empty()) shm::check_link_name(options.link);
    const fs::path engine_dir = fs::canonical(options.folder);
    ImportReport report;
    const EngineConfig config = read_engine_config(engine_dir, report);
    const auto application = engine::read_application_profile(find_application(config, options.application));
    ImportFolder folder(options.output, options.folder, "opros");
    folder.complete(report, [&] {
        write_import({engine_dir, config, application, options.link}, folder.path(), report);
    });
    report.print(folder.output(), "host/opros/README.md", "applications", options.json);
    return 0;
}

} // namespace tandem::command
