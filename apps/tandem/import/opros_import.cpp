// SPDX-License-Identifier: Apache-2.0
// tandem opros import: turns an installation of the OPRoS engine into DIR/opros for tandem run.
#include "apps/tandem/build/folder/source_text.hpp"
#include "apps/tandem/import/commands.hpp"
#include "apps/tandem/import/component_differences.hpp"
#include "apps/tandem/import/engine_config.hpp"
#include "apps/tandem/import/import_folder.hpp"

#include "host/opros/engine/load/plugin_dirs.hpp"
#include "host/opros/engine/profile/flatten_composites.hpp"
#include "host/opros/engine/profile/profile_kind.hpp"
#include "host/opros/engine/profile/xml_file.hpp"

#include <cerrno>
#include <cstring>
#include <set>
#include <stdexcept>

namespace tandem::command {
namespace {

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
    ApplicationCopy(const engine::ApplicationProfile& application, const fs::path& output,
                    ImportReport& report)
        : application_(application), from_(application.location.file.parent_path()), output_(output),
          report_(report) {}

    void copy_components() {
        for (const auto& component : application_.subcomponents) {
            // Components of Tandem, such as AdaptorComp, are not copied: the host finds them.
            const fs::path file =
                engine::find_component_profile(application_, component, engine::default_plugin_dirs());
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
        if (link.empty() && moved_.empty()) {
            fs::copy_file(file, target);
        } else {
            save(file, target, link);
        }
        report_.add_file(target);
    }

  private:
    static bool is_ours(const fs::path& file) {
        for (const auto& folder : engine::default_plugin_dirs())
            if (file.parent_path() == folder) return true;
        return false;
    }

    void copy_file(const fs::path& file, const fs::path& target) {
        if (is_library(file) || !copied_.insert(target).second) return;
        if (copied_.size() > max_files)
            throw std::runtime_error(
                from_.string() + " has more than " + std::to_string(max_files) +
                " files beside its profiles: move the application to a folder of its own files only");
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
        if (!link.empty()) {
            auto adaptor = list.append_child("subcomponent");
            adaptor.append_child("name").text().set("Adaptor");
            adaptor.append_child("reference").text().set("AdaptorComp.xml");
            auto property = adaptor.append_child("properties").append_child("property");
            property.append_attribute("name") = "link";
            property.text().set(link.c_str());
        }
        if (!document.save_file(target.c_str(), "  "))
            throw std::runtime_error(target.string() + " cannot be written: " + std::strerror(errno));
    }

    static constexpr std::size_t max_files = 10000;
    const engine::ApplicationProfile& application_;
    fs::path from_, output_;
    ImportReport& report_;
    std::map<std::string, std::string> moved_; // components whose folder moved, with their new reference
    std::map<fs::path, fs::path> folders_;     // copied folders: new path to old path
    std::set<fs::path> copied_;
};

} // namespace

int opros_import(const OprosImportOptions& options) {
    if (!fs::is_directory(options.folder))
        throw std::runtime_error(options.folder.string() +
                                 " is not a folder: expected an installation of the OPRoS engine");
    require_link_name(options.link);
    const fs::path engine_dir = fs::canonical(options.folder);
    ImportReport report;
    const EngineConfig config = read_engine_config(engine_dir, report);
    const auto application = engine::read_application_profile(find_application(config, options.application));
    ImportFolder folder(options.output, options.folder, "opros");
    ApplicationCopy copy(application, folder.path(), report);
    copy.copy_components();
    copy.write_application(options.link);
    // From here on, reports name files in the new folder, because users edit those.
    tell_application_differences(application, config, report);
    const auto written =
        engine::read_application_profile(folder.path() / application.location.file.filename());
    const ComponentPlaces places{engine_dir, application, copy.folders()};
    for (const auto& component :
         engine::flatten_composites(written, engine::default_plugin_dirs()).subcomponents)
        if (component.file.string().starts_with(folder.path().string()))
            import_component(component, places, report);
    folder.keep();
    report.print(folder.output(), "host/opros/README.md lists the differences common to all applications",
                 options.json);
    return 0;
}

} // namespace tandem::command
