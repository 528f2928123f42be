// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/folder/source_text.hpp"
#include "apps/tandem/census/candidate.hpp"
#include "apps/tandem/opros/component_profiles.hpp"
#include "apps/tandem/opros/probe_tasks.hpp"
#include "apps/tandem/output/print.hpp"
#include "host/opros/engine/profile/component_profile.hpp"
#include "host/opros/engine/profile/profile_kind.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <sstream>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

using Profile = std::optional<engine::ComponentProfile>;

// Returns nothing for other files. `profile`: what the file contains, if it can be read.
std::optional<Candidate> read_candidate(const fs::path& file, const fs::path& folder, Profile& profile) {
    // Other XML files may be damaged as they like.
    if (read_text(file).find("component_profile") == std::string::npos) return std::nullopt;
    try {
        if (engine::find_profile_kind(file) != engine::ProfileKind::component) return std::nullopt;
        profile = engine::read_component_profile(file);
        return Candidate{profile->name, folder, file};
    } catch (const engine::SetupError& error) {
        return Candidate{file.stem().string(), folder, file, error.what()};
    }
}

bool contains_source(const std::vector<fs::path>& files) {
    return std::any_of(files.begin(), files.end(), [](const auto& file) { return is_source(file); });
}

// Folders of device libraries may have the profile of the component that uses them.
bool contains_component(const std::vector<fs::path>& files) {
    return std::any_of(files.begin(), files.end(), [](const auto& file) {
        return is_source(file) && read_text(file).find("getComponent") != std::string::npos;
    });
}

// Returns the sources below the folder that define a component.
std::vector<fs::path> find_entries(const fs::path& folder) {
    std::vector<fs::path> entries;
    for (const auto& file : list_files_below(folder))
        if (is_source(file) && defines_function(read_text(file), "getComponent")) entries.push_back(file);
    return entries;
}

/// Finds the components of a folder. Several copies of a profile are one component.
class Finder {
  public:
    explicit Finder(std::size_t& without_source) : without_source_(without_source) {}

    void add(const fs::path& file) {
        const auto parent = file.parent_path();
        const auto place = parent.filename();
        Profile profile;
        auto candidate = read_candidate(
            file, place == "profile" || place == "profiles" ? parent.parent_path() : parent, profile);
        if (!candidate) return;
        candidate->folder = find_folder(candidate->folder, candidate->name);
        if (!contains_component(list_files_below(candidate->folder))) {
            ++without_source_;
            return;
        }
        auto& known = profiles_[candidate->folder];
        if (profile && std::any_of(known.begin(), known.end(), [&](const auto& other) {
                return find_difference(other, *profile).empty();
            }))
            return;
        if (profile) known.push_back(std::move(*profile));
        found.push_back(std::move(*candidate));
    }

    std::vector<Candidate> found;

  private:
    // Returns the folder of the component whose profile belongs to `folder`. Workspaces have one folder with the profiles of
    // all components, whose folders have their names.
    fs::path find_folder(const fs::path& folder, const std::string& name) {
        if (contains_source(list_files(folder)) || contains_source(list_files(folder / "src"))) return folder;
        auto known = entries_.find(folder);
        if (known == entries_.end()) known = entries_.emplace(folder, find_entries(folder)).first;
        if (known->second.size() < 2) return folder;
        for (const auto& entry : known->second)
            for (auto at = entry.parent_path(); at != folder; at = at.parent_path())
                if (at.filename() == name) return at;
        return folder;
    }

    std::map<fs::path, std::vector<fs::path>> entries_; ///< by the folder; reading all its sources takes long
    std::map<fs::path, std::vector<engine::ComponentProfile>> profiles_; ///< by the component's folder
    std::size_t& without_source_;
};

std::vector<Candidate> find_opros(const fs::path& top, std::size_t& without_source) {
    Finder finder(without_source);
    for (const auto& file : list_files_below(top))
        if (is_xml(file)) finder.add(file);
    return std::move(finder.found);
}

std::string application_with(const std::string& name, const std::string& profile) {
    pugi::xml_document document;
    auto root = document.append_child("package_profile");
    root.append_child("name").text() = "census";
    auto component = root.append_child("subcomponents").append_child("subcomponent");
    component.append_child("name").text() = name.c_str();
    component.append_child("reference").text() = profile.c_str();
    std::ostringstream text;
    document.save(text);
    return text.str();
}

std::vector<std::string> load_opros(const Candidate& candidate, const fs::path& library) {
    const auto profile = library.parent_path() / candidate.profile.filename();
    if (!fs::exists(profile)) fs::copy_file(candidate.profile, profile);
    describe_in_child(library, profile, {});
    const auto application = library.parent_path() / "census-application.xml";
    write_file(application, application_with(candidate.name, profile.filename()));
    return {"opros_host", application.string(), "--strict"};
}

} // namespace

const CensusModel opros_census_model{"opros", "--profile", find_opros, load_opros};

} // namespace tandem::command
