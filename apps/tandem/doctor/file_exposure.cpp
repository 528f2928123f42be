// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/doctor/exposure.hpp"
#include "apps/tandem/output/format.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

namespace tandem::doctor {
namespace {

namespace fs = std::filesystem;

/// Returns why the folder is not for this user alone; an empty text if it is, or does not exist.
std::string fault_of(const fs::path& folder, uid_t user) {
    struct stat status {};
    if (::lstat(folder.c_str(), &status) != 0) return "";
    if (!S_ISDIR(status.st_mode)) return "is not a folder";
    if (status.st_uid != user) return "belongs to " + command::user_name(status.st_uid);
    if ((status.st_mode & 077) != 0) return fmt::format("has mode {:04o}", status.st_mode & 07777);
    return "";
}

} // namespace

CheckResult check_segment_modes(const Machine& machine) {
    const std::string name = "access to segments";
    std::size_t count = 0;
    std::string for_group, for_all;
    std::error_code none;
    for (fs::directory_iterator it(machine.path("/dev/shm"), none), end; !none && it != end;
         it.increment(none)) {
        const std::string file = it->path().filename().string();
        struct stat status {};
        if (file.compare(0, 7, "tandem.") != 0 || ::lstat(it->path().c_str(), &status) != 0 ||
            !S_ISREG(status.st_mode) || status.st_uid != machine.probed.user)
            continue;
        ++count;
        std::string& list = (status.st_mode & 007) != 0 ? for_all : for_group;
        if ((status.st_mode & 077) != 0)
            list += fmt::format("{}{} (mode {:04o}, group {})", list.empty() ? "" : ", ",
                                command::replace_nonprintable(file), status.st_mode & 07777, status.st_gid);
    }
    if (!for_all.empty())
        return error(name, for_all, "every user can open these links: end their hosts and remove the files");
    if (!for_group.empty())
        return warning(name, for_group,
                       "members of the group count as the other process of the link: remove the "
                       "setting group of the link unless they need it");
    return ok(name, count == 0 ? "no segment of this user"
                               : fmt::format("{} of this user, only for this user", count));
}

CheckResult check_runtime_folder(const Machine& machine) {
    const std::string name = "runtime folder";
    const std::string set = machine.probed.runtime_dir;
    const std::string folder = set.empty() ? fmt::format("/run/user/{}", machine.probed.user) : set;
    const std::string shown = command::replace_control_characters(folder);
    if (folder.front() != '/')
        return warning(name, shown,
                       "XDG_RUNTIME_DIR is not an absolute path, so that hosts use a folder in /dev/shm: "
                       "log in again, or unset it");
    for (const std::string& each : {folder, folder + "/tandem"}) {
        const std::string fault = fault_of(machine.path(each), machine.probed.user);
        if (!fault.empty())
            return warning(
                name, command::replace_control_characters(each) + " " + fault,
                "hosts do not use it and keep their sockets in /dev/shm: give it mode 0700 and this user");
    }
    if (!machine.exists(folder)) return ok(name, shown + " does not exist; hosts use a folder in /dev/shm");
    return ok(name, shown + ", only for this user");
}

} // namespace tandem::doctor
