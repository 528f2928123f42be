// SPDX-License-Identifier: Apache-2.0
#include "shm/segment/segment_file.hpp"

#include "shm/os/error.hpp"
#include "shm/os/link_name.hpp"
#include "shm/segment/liveness.hpp"

#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <grp.h>
#include <sys/stat.h>
#include <sys/statvfs.h>

// boost::interprocess::shared_memory_object offers neither O_TMPFILE nor O_NOFOLLOW nor O_CLOEXEC, so this file uses open() and
// linkat(). A segment starts as an unnamed file and gets its name when it is complete: no process ever sees an incomplete
// segment, and a creator that is killed leaves nothing behind.

namespace tandem::shm {
namespace {

constexpr int safe_open = O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;

std::string octal(mode_t mode) {
    std::string text = "0000";
    for (std::size_t digit = 4; digit-- > 0; mode >>= 3) text[digit] = static_cast<char>('0' + (mode & 7U));
    return text;
}

std::string describe(const Access& access) {
    std::string text = "owner " + std::to_string(access.owner);
    if (access.group) text += " or group " + std::to_string(*access.group);
    return text + ", mode " + octal(access.mode());
}

void check_access(const struct stat& file, const std::string& path, const Access& access) {
    if (S_ISREG(file.st_mode) && (file.st_mode & 07777) == access.mode()) return;
    throw Error(path + ": has owner " + std::to_string(file.st_uid) + ", mode " +
                octal(file.st_mode & 07777) + ", expected " + describe(access) +
                "; remove it or choose another link name");
}

/// Returns what is known of a file that cannot be opened; empty if it is gone. Does not follow a symbolic link.
std::optional<struct stat> status_of(const std::string& path) {
    struct stat file {};
    if (lstat(path.c_str(), &file) != 0) return std::nullopt;
    return file;
}

[[noreturn]] void throw_no_space(const std::string& path, std::uint64_t bytes, int code) {
    const auto available = available_bytes();
    throw Error(path + ": " + std::to_string(bytes) + " bytes needed, " +
                (available ? std::to_string(*available) : "unknown") + " available in " + shm_directory +
                " (" + errno_text(code) + "); free some, enlarge it, or ask for a smaller arena");
}

/// Calls posix_fallocate(), and repeats it when a signal interrupts it. Returns an errno value.
int allocate(int fd, std::uint64_t offset, std::uint64_t bytes) {
    int code = EINTR;
    constexpr int max_interruptions = 1000;
    for (int i = 0; i < max_interruptions && code == EINTR; ++i)
        code = posix_fallocate(fd, static_cast<off_t>(offset), static_cast<off_t>(bytes));
    return code;
}

} // namespace

void check_link_name(const std::string& link) {
    if (is_link_name(link)) return;
    throw Error("link name '" + link + "': expected 1 to 64 characters of A-Z a-z 0-9 _ -, the first not -");
}

std::string file_prefix(const std::string& link) { return "tandem." + link + "."; }

std::string segment_path(const std::string& link, std::uint64_t generation) {
    return std::string(shm_directory) + "/" + file_prefix(link) + std::to_string(generation);
}

Access access_of_this_process(const std::string& group) {
    Access access{geteuid(), std::nullopt};
    if (group.empty()) return access;
    std::vector<char> buffer(16384);
    struct group entry {};
    struct group* found = nullptr;
    getgrnam_r(group.c_str(), &entry, buffer.data(), buffer.size(), &found);
    if (found == nullptr)
        throw Error("group '" + group + "': unknown to this system; create it or name another");
    access.group = entry.gr_gid;
    return access;
}

bool Access::counts(const struct stat& file) const {
    return file.st_uid == owner || (group && S_ISREG(file.st_mode) && file.st_gid == *group);
}

FileDescriptor open_segment(const std::string& path, const Access& access) {
    FileDescriptor file(::open(path.c_str(), O_RDWR | safe_open));
    if (!file) {
        const int code = errno;
        if (code == ENOENT) return file; // another process may name a file now
        const auto status = status_of(path);
        if (!status || !access.counts(*status)) return file;
        throw Error(path + ": cannot be opened (" + errno_text(code) + "), expected " + describe(access) +
                    "; remove it or choose another link name");
    }
    struct stat opened {};
    if (fstat(file.get(), &opened) != 0) throw Error(path + ": cannot be examined (" + errno_text() + ")");
    if (!access.counts(opened)) return {};
    check_access(opened, path, access);
    return file;
}

Probe probe_segment(const std::string& path, const Access& access) {
    Probe probe;
    const FileDescriptor file(::open(path.c_str(), O_RDONLY | safe_open));
    std::optional<struct stat> status;
    if (!file) {
        status = status_of(path);
        probe.busy = true; // this process may not open it, so it must not count as dead
    } else if (struct stat opened{}; fstat(file.get(), &opened) == 0) {
        status = opened;
    }
    probe.exists = status.has_value();
    probe.foreign = status && !access.counts(*status);
    if (!file || probe.foreign) return probe;
    return Probe{probe.exists,
                 {side_lives(file.get(), Side::first), side_lives(file.get(), Side::second)},
                 held_by_other(file.get(), LockByte::hand_over)};
}

std::optional<std::uint64_t> available_bytes() {
    struct statvfs disk {};
    if (statvfs(shm_directory, &disk) != 0) return std::nullopt;
    return disk.f_bavail * disk.f_frsize;
}

bool try_reserve(int fd, std::uint64_t offset, std::uint64_t bytes) {
    return allocate(fd, offset, bytes) == 0;
}

void reserve(int fd, const std::string& path, std::uint64_t offset, std::uint64_t bytes) {
    if (const int code = allocate(fd, offset, bytes); code != 0) throw_no_space(path, bytes, code);
}

namespace {

FileDescriptor unnamed_file(const std::string& path, std::uint64_t reserved, const Access& access) {
    FileDescriptor file(::open(shm_directory, O_TMPFILE | O_RDWR | O_CLOEXEC, 0600));
    if (!file)
        throw Error(path + ": cannot be created (" + errno_text() + "); a writable tmpfs is expected at " +
                    shm_directory);
    reserve(file.get(), path, 0, reserved);
    if (access.group && fchown(file.get(), static_cast<uid_t>(-1), *access.group) != 0)
        throw Error(path + ": cannot be given to group " + std::to_string(*access.group) + " (" +
                    errno_text() + "); this process must be a member of it");
    if (fchmod(file.get(), access.mode()) != 0)
        throw Error(path + ": cannot be given mode " + octal(access.mode()) + " (" + errno_text() + ")");
    return file;
}

} // namespace

FileDescriptor create_unnamed(const std::string& path, std::uint64_t bytes, const Access& access) {
    return unnamed_file(path, bytes, access);
}

FileDescriptor create_sparse(const std::string& path, std::uint64_t bytes, std::uint64_t required_bytes,
                             const Access& access) {
    if (available_bytes().value_or(required_bytes) < required_bytes)
        throw_no_space(path, required_bytes, ENOSPC);
    FileDescriptor file = unnamed_file(path, layout::arenas_begin, access);
    if (ftruncate(file.get(), static_cast<off_t>(bytes)) != 0) throw_no_space(path, bytes, errno);
    return file;
}

bool link_unnamed(int fd, const std::string& path) {
    const std::string self = "/proc/self/fd/" + std::to_string(fd);
    if (linkat(AT_FDCWD, self.c_str(), AT_FDCWD, path.c_str(), AT_SYMLINK_FOLLOW) == 0) return true;
    if (errno == EEXIST) return false;
    throw Error(path + ": cannot be named (" + errno_text() + "); " + shm_directory +
                " must be writable and /proc mounted");
}

bool still_named(int fd) {
    struct stat file {};
    return fstat(fd, &file) == 0 && file.st_nlink > 0;
}

void announce_change(int fd) { futimens(fd, nullptr); }

namespace {

/// Throws Error unless this process and the creator of the segment interpret its bytes in the same way.
void check_layout(const layout::SegmentHeader& header, const std::string& path) {
    const auto refuse = [&](const std::string& theirs, const std::string& ours) {
        throw Error(path + ": has " + theirs + ", this process has " + ours +
                    "; use one build of Tandem on both sides");
    };
    if (header.magic == __builtin_bswap64(layout::magic))
        throw Error(path +
                    ": has the byte order of another processor; use one build of Tandem on both sides");
    if (header.magic != layout::magic)
        throw Error(path + ": is not a Tandem segment; remove it or choose another link name");
    if (header.layout_version != layout::layout_version)
        refuse("layout version " + std::to_string(header.layout_version),
               std::to_string(layout::layout_version));
    const auto units = [](std::size_t line, std::size_t page) {
        return std::to_string(line) + " and " + std::to_string(page);
    };
    if (header.line_bytes != layout::line || header.page_bytes != layout::page)
        refuse("lines and pages of " + units(header.line_bytes, header.page_bytes) + " bytes",
               units(layout::line, layout::page));
}

} // namespace

layout::SegmentHeader read_header(int fd, const std::string& path, std::uint64_t contract) {
    layout::SegmentHeader header{};
    struct stat file {};
    const auto got = pread(fd, static_cast<void*>(&header), sizeof header, 0);
    if (got != static_cast<ssize_t>(sizeof header) || fstat(fd, &file) != 0)
        throw Error(path + ": is not a Tandem segment; remove it or choose another link name");
    check_layout(header, path);
    if (header.contract != contract)
        throw Error(path + ": has contract version " + std::to_string(header.contract) +
                    ", this process has " + std::to_string(contract) +
                    "; use one build of the link on both sides");
    const auto& offset = header.arena_offset;
    const auto& bytes = header.arena_bytes;
    const std::uint64_t total = header.total_bytes;
    const bool valid =
        header.header_bytes == sizeof header && total <= static_cast<std::uint64_t>(file.st_size) &&
        total >= layout::arenas_begin && offset[0] == layout::arenas_begin && bytes[0] <= total - offset[0] &&
        bytes[0] % layout::page == 0 && offset[1] == offset[0] + bytes[0] && bytes[1] == total - offset[1];
    if (!valid) throw Error(path + ": has a damaged header; remove it or choose another link name");
    return header;
}

bool remove_if_dead(const std::string& path) {
    const FileDescriptor file(::open(path.c_str(), O_RDWR | safe_open));
    if (!file) return errno == ENOENT;
    struct stat status {};
    if (fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode) || status.st_uid != geteuid())
        return false;
    // The hand-over byte must be held: while the file has a name, this name is `path`, and unlink() cannot remove a younger
    // file of the same name.
    const HandOverLock hand_over(file.get(), std::chrono::milliseconds(0));
    if (!hand_over.held()) return false;
    if (side_lives(file.get(), Side::first) || side_lives(file.get(), Side::second)) return false;
    return !still_named(file.get()) || ::unlink(path.c_str()) == 0;
}

void remove_dead(const std::string& link) {
    check_link_name(link);
    for (const auto generation : list_generations(link)) {
        const std::string path = segment_path(link, generation);
        if (probe_segment(path).dead()) remove_if_dead(path);
    }
}

} // namespace tandem::shm
