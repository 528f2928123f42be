// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/print_note.hpp"
#include "apps/tandem/system/commands.hpp"
#include "apps/tandem/system/running_system.hpp"
#include "apps/tandem/system/staged_folder.hpp"

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

/// Copies the files from which the hosts run into a new folder, and writes what has changed since.
std::vector<std::string> save_into(StagedFolder& staged, const RunningSystem& system, bool in_place) {
    std::vector<std::string> left_out;
    const auto add = [&](pid_t host, const char* side, const fs::path& file, auto save) {
        if (host == 0) return;
        const fs::path folder = in_place ? staged.path() / side : staged.add_side(side);
        if (in_place)
            fs::create_directories(folder);
        else
            copy_side(file.parent_path(), folder);
        const auto lines = save(system, staged.path());
        left_out.insert(left_out.end(), lines.begin(), lines.end());
    };
    add(system.rtm, "rtm", system.rtc_conf, save_rtm);
    add(system.opros, "opros", system.application, save_opros);
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
    StagedFolder staged(options.folder);
    const auto left_out = save_into(staged, system, in_place);
    if (in_place)
        staged.publish_files();
    else
        staged.publish();
    for (const auto& line : left_out) print_note("tandem: not saved: {}\n", line);
    print_text("saved " + options.folder.string() + "\n");
    return 0;
}

} // namespace tandem::command
