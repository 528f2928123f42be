// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/import/import_folder.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/print_note.hpp"
#include "apps/tandem/system/commands.hpp"
#include "apps/tandem/system/running_system.hpp"

#include <optional>
#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_files = 10000;

/// Copies the files of one side, opros/ or rtm/, of a folder for `tandem run`. Other folders may contain anything: the
/// saved files refer to them.
void copy_side(const fs::path& from, const fs::path& to) {
    if (from.filename() != to.filename()) return;
    std::size_t copied = 0;
    for (const auto& entry : fs::recursive_directory_iterator(from)) {
        const fs::path target = to / entry.path().lexically_relative(from);
        if (entry.is_directory()) fs::create_directories(target);
        if (!entry.is_regular_file()) continue;
        if (++copied > max_files)
            throw std::runtime_error(from.string() +
                                     " has more than 10000 files: move what is not configuration "
                                     "to another folder");
        fs::copy_file(entry.path(), target, fs::copy_options::overwrite_existing);
    }
}

/// Saves into the folder from which the hosts run. Keeps the former files.
std::vector<std::string> save_in_place(const RunningSystem& system) {
    std::vector<std::string> left_out;
    const auto add = [&](const fs::path& file, auto save) {
        if (file.empty()) return;
        fs::path former = file;
        fs::copy_file(file, former += "~", fs::copy_options::overwrite_existing);
        const auto lines = save(system, file.parent_path().parent_path());
        left_out.insert(left_out.end(), lines.begin(), lines.end());
    };
    add(system.rtc_conf, save_rtm);
    add(system.application, save_opros);
    return left_out;
}

std::vector<std::string> save_as(const RunningSystem& system, const fs::path& folder) {
    std::optional<ImportFolder> rtm, opros; // made before anything is written
    if (system.rtm != 0) rtm.emplace(folder, fs::path(), "rtm");
    if (system.opros != 0) opros.emplace(folder, fs::path(), "opros");
    std::vector<std::string> left_out;
    const auto add = [&](std::optional<ImportFolder>& side, const fs::path& file, auto save) {
        if (!side) return;
        copy_side(file.parent_path(), side->path());
        const auto lines = save(system, side->path().parent_path());
        left_out.insert(left_out.end(), lines.begin(), lines.end());
    };
    add(rtm, system.rtc_conf, save_rtm);
    add(opros, system.application, save_opros);
    if (rtm) rtm->keep();
    if (opros) opros->keep();
    return left_out;
}

bool runs_from(const RunningSystem& system, const fs::path& folder) {
    const auto is_in = [&](const fs::path& file, const char* side) {
        return file.empty() ||
               fs::weakly_canonical(file.parent_path()) == fs::weakly_canonical(folder / side);
    };
    // A host with -f OTHER.conf runs from another file than the one that would be written.
    const bool has_name = system.rtc_conf.empty() || system.rtc_conf.filename() == "rtc.conf";
    return has_name && is_in(system.rtc_conf, "rtm") && is_in(system.application, "opros");
}

} // namespace

int system_save(const SaveSystemOptions& options) {
    const RunningSystem system = find_running_system(options.hosts);
    const bool in_place = runs_from(system, options.folder);
    if (in_place && !options.replace)
        throw std::runtime_error("the system runs from " + options.folder.string() +
                                 "; to change its files, use --replace, or name another folder");
    const auto left_out = in_place ? save_in_place(system) : save_as(system, options.folder);
    for (const auto& line : left_out) print_note("tandem: not saved: {}\n", line);
    print_text("saved " + options.folder.string() + "\n");
    return 0;
}

} // namespace tandem::command
