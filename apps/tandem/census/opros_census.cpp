// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/folder/source_text.hpp"
#include "apps/tandem/census/candidate.hpp"
#include "apps/tandem/opros/probe_tasks.hpp"
#include "apps/tandem/output/print.hpp"
#include "host/opros/engine/profile/component_profile.hpp"
#include "host/opros/engine/profile/profile_kind.hpp"

#include <algorithm>
#include <pugixml.hpp>
#include <sstream>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

// Returns nothing for other files.
std::optional<Candidate> read_candidate(const fs::path& file, const fs::path& folder) {
    // Other XML files may be damaged as they like.
    if (read_text(file).find("component_profile") == std::string::npos) return std::nullopt;
    try {
        if (engine::find_profile_kind(file) != engine::ProfileKind::component) return std::nullopt;
        return Candidate{engine::read_component_profile(file).name, folder, file};
    } catch (const engine::SetupError& error) {
        return Candidate{file.stem().string(), folder, file, error.what()};
    }
}

bool has_source(const fs::path& folder) {
    const auto files = list_files_below(folder);
    return std::any_of(files.begin(), files.end(), [](const auto& file) { return is_source(file); });
}

std::vector<Candidate> find_opros(const fs::path& top, std::size_t& without_source) {
    std::vector<Candidate> found;
    for (const auto& file : list_files_below(top)) {
        if (!is_xml(file)) continue;
        const auto parent = file.parent_path();
        const auto place = parent.filename();
        const bool is_beside = place == "profile" || place == "profiles";
        auto candidate = read_candidate(file, is_beside ? parent.parent_path() : parent);
        if (!candidate) continue;
        if (has_source(candidate->folder))
            found.push_back(std::move(*candidate));
        else
            ++without_source;
    }
    return found;
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
