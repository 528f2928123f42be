// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/doctor/checks.hpp"
#include "apps/tandem/text.hpp"

#include <sstream>

namespace tandem::doctor {
namespace {

struct Mount {
    std::string type, options;

    /// The value of an option ("" if it has none); empty if it is not there.
    std::optional<std::string> option(const std::string& name) const {
        std::istringstream list(options);
        for (std::string one; std::getline(list, one, ',');)
            if (one.substr(0, one.find('=')) == name)
                return one.find('=') == std::string::npos ? "" : one.substr(one.find('=') + 1);
        return std::nullopt;
    }
};

/// The mount that is seen at /dev/shm: of several on top of each other the last.
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

Finding check_shm_mount(const Machine& machine) {
    const std::string name = "/dev/shm mount", remedy = "mount -t tmpfs -o size=50%,mode=1777 tmpfs /dev/shm";
    const auto mount = shm_mount(machine);
    if (!mount) return bad(name, "nothing is mounted there", remedy);
    if (mount->type != "tmpfs") return bad(name, mount->type, "segments must not touch a disk: " + remedy);
    if (mount->option("ro")) return bad(name, "tmpfs, read-only", "mount -o remount,rw /dev/shm");
    return ok(name, "tmpfs");
}

Finding check_shm_space(const Machine& machine) {
    constexpr std::uint64_t mib = 1 << 20, one_link = 16 * mib, comfortable = 256 * mib;
    const std::uint64_t free = machine.answers.shm_free;
    const std::string name = "/dev/shm space",
                      remedy = "mount -o remount,size=1G /dev/shm (docker run --shm-size 1g)";
    const std::string seen =
        command::bytes_text(free) + " free of " + command::bytes_text(machine.answers.shm_bytes);
    if (free < one_link)
        return bad(name, seen,
                   "a link takes 1 MiB or more, and 8 MiB for each image under way: tandem shm clean, or " +
                       remedy);
    if (free < comfortable) return warn(name, seen, "enough for small messages only; for images " + remedy);
    return ok(name, seen);
}

// Segments are reserved in full by posix_fallocate(): that makes huge pages under huge=within_size and
// always, and small ones under huge=advise. shmem_enabled rules over other shared memory, except for deny and
// force.
Finding check_huge_pages(const Machine& machine) {
    const std::string name = "huge pages in /dev/shm";
    const auto choices = machine.first_line("/sys/kernel/mm/transparent_hugepage/shmem_enabled");
    if (!choices)
        return warn(name, "not in this kernel",
                    "large payloads cost more TLB misses; use a kernel with CONFIG_TRANSPARENT_HUGEPAGE");
    const std::string global = bracketed(*choices);
    if (global == "force") return ok(name, "forced for all shared memory");
    if (global == "deny")
        return warn(
            name, "denied for all shared memory",
            "for large payloads: echo never > /sys/kernel/mm/transparent_hugepage/shmem_enabled, then "
            "mount -o remount,huge=within_size /dev/shm");
    const auto mount = shm_mount(machine);
    const std::string huge = mount ? mount->option("huge").value_or("never") : "never";
    if (huge == "within_size" || huge == "always") return ok(name, "huge=" + huge);
    return warn(name, "huge=" + huge, "for large payloads: mount -o remount,huge=within_size /dev/shm");
}

} // namespace tandem::doctor
