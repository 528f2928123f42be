// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/doctor/checks.hpp"
#include "apps/tandem/output/format.hpp"

#include <sstream>

namespace tandem::doctor {
namespace {

/// One line of /proc/self/mounts.
struct Mount {
    std::string type, options; ///< "tmpfs", "rw,nosuid,size=1g"

    /// Returns the value of an option, "" if it has no value; nullopt if the option is absent.
    std::optional<std::string> option(const std::string& name) const {
        std::istringstream list(options);
        for (std::string one; std::getline(list, one, ',');)
            if (one.substr(0, one.find('=')) == name)
                return one.find('=') == std::string::npos ? "" : one.substr(one.find('=') + 1);
        return std::nullopt;
    }
};

/// Returns the mount at /dev/shm. If several mounts are on top of each other, the last one is visible.
std::optional<Mount> shm_mount(const Machine& machine) {
    std::optional<Mount> found;
    std::istringstream lines(machine.content("/proc/self/mounts").value_or(""));
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string source, place;
        Mount mount;
        if (words >> source >> place >> mount.type >> mount.options && place == "/dev/shm") found = mount;
    }
    return found;
}

} // namespace

// A file system on a disk would write messages back to the disk. shm_open() does not notice the difference.
CheckResult check_shm_mount(const Machine& machine) {
    const std::string name = "/dev/shm mount",
                      remedy = "run mount -t tmpfs -o size=50%,mode=1777 tmpfs /dev/shm";
    const auto mount = shm_mount(machine);
    if (!mount) return error(name, "nothing is mounted there", remedy);
    if (mount->type != "tmpfs")
        return error(name, mount->type, "segments must not be written to a disk: " + remedy);
    if (mount->option("ro")) return error(name, "tmpfs, read-only", "run mount -o remount,rw /dev/shm");
    return ok(name, "tmpfs");
}

// Checks free space, not size: other programs and segments of dead hosts reduce the room for new links.
CheckResult check_shm_space(const Machine& machine) {
    // 16 MiB suffice for a few links with small messages. Each image in transit takes 8 MiB.
    constexpr std::uint64_t mib = 1 << 20, one_link = 16 * mib, comfortable = 256 * mib;
    const std::uint64_t free = machine.probed.shm_free;
    const std::string name = "/dev/shm space";
    const std::string remedy =
        "run mount -o remount,size=1G /dev/shm (in a container, use docker run --shm-size 1g)";
    const std::string value =
        command::format_bytes(free) + " free of " + command::format_bytes(machine.probed.shm_bytes);
    if (free < one_link)
        return error(
            name, value,
            "a link takes 1 MiB or more, plus 8 MiB for each image in transit: run tandem shm clean, or " +
                remedy);
    if (free < comfortable)
        return warning(name, value, "enough only for small messages: for images, " + remedy);
    return ok(name, value);
}

// posix_fallocate() reserves segments in full. It allocates huge pages under huge=within_size and
// huge=always, but small pages under huge=advise. The kernel's shmem_enabled is for shared memory without a
// mount point; only its values deny and force also override the mount.
CheckResult check_huge_pages(const Machine& machine) {
    const std::string name = "huge pages in /dev/shm";
    const auto choices = machine.first_line("/sys/kernel/mm/transparent_hugepage/shmem_enabled");
    if (!choices)
        return warning(name, "not in this kernel",
                       "large payloads cause more TLB misses: use a kernel with CONFIG_TRANSPARENT_HUGEPAGE");
    // The kernel marks the value in use: "always within_size advise [never] deny force".
    const std::string global = bracketed_word(*choices);
    if (global == "force") return ok(name, "forced for all shared memory");
    if (global == "deny")
        return warning(name, "denied for all shared memory",
                       "large payloads cause more TLB misses: run echo never > "
                       "/sys/kernel/mm/transparent_hugepage/shmem_enabled, then mount -o "
                       "remount,huge=within_size /dev/shm");
    const auto mount = shm_mount(machine);
    const std::string huge = mount ? mount->option("huge").value_or("never") : "never";
    if (huge == "within_size" || huge == "always") return ok(name, "huge=" + huge);
    return warning(name, "huge=" + huge,
                   "large payloads cause more TLB misses: run mount -o remount,huge=within_size /dev/shm");
}

} // namespace tandem::doctor
