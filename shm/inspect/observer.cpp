// SPDX-License-Identifier: Apache-2.0
#include "shm/inspect/observer.hpp"

#include "shm/inspect/read_only_snapshot.hpp"
#include "shm/os/error.hpp"
#include "shm/segment/liveness.hpp"

#include <algorithm>
#include <fstream>
#include <sys/stat.h>

namespace tandem::shm {
namespace {

/// Checks the effective group and the supplementary ones, as the kernel does.
bool member_of(gid_t group) {
    if (group == getegid()) return true;
    std::vector<gid_t> groups(static_cast<std::size_t>(std::max(0, getgroups(0, nullptr))));
    const int known = getgroups(static_cast<int>(groups.size()), groups.data());
    return known > 0 && std::find(groups.begin(), groups.begin() + known, group) != groups.begin() + known;
}

/// Returns whether this process may use the segment: as its owner, or as a member of the group that the segment is shared
/// with.
bool may_use(const struct stat& file) {
    return file.st_uid == geteuid() ||
           (S_ISREG(file.st_mode) && (file.st_mode & 07777) == 0660 && member_of(file.st_gid));
}

/// Sets both sizes, because a sparse file takes less memory than its size.
void set_sizes(const struct stat& file, ObservedSegment& view) {
    constexpr std::uint64_t block = 512; // unit of st_blocks
    view.file_bytes = static_cast<std::uint64_t>(file.st_size);
    view.memory_bytes = static_cast<std::uint64_t>(file.st_blocks) * block;
}

/// Returns what is known about the file without opening it; empty if it is gone.
std::optional<ObservedSegment> read_file_status(const std::string& link, std::uint64_t generation) {
    ObservedSegment view;
    view.link = link;
    view.generation = generation;
    view.path = segment_path(link, generation);
    struct stat file {};
    // Not stat(): a symbolic link under the name of a segment is damage, and is not followed.
    if (lstat(view.path.c_str(), &file) != 0) return std::nullopt;
    set_sizes(file, view);
    view.owner = file.st_uid;
    view.mode = file.st_mode & 07777;
    view.readability = !may_use(file)          ? Readability::foreign
                       : S_ISREG(file.st_mode) ? Readability::readable
                                               : Readability::damaged;
    if (view.readability == Readability::damaged) view.reason = "not a regular file";
    if (view.readability == Readability::foreign) view.reason = "of another user";
    return view;
}

void set_unreadable(ObservedSegment& view, Readability as, std::string reason) {
    view.readability = as;
    view.reason = std::move(reason);
}

/// Reads the segment header. Any mismatch makes the segment unreadable, with the reason.
void read_header_fields(const ReadOnlySnapshot& file, ObservedSegment& view) {
    using layout::SegmentHeader;
    Snapshot<SegmentHeader> copy;
    if (!file.read(0, copy)) return set_unreadable(view, Readability::damaged, "shorter than a header");
    const auto word = [&](std::size_t offset) { return copy.get<std::uint64_t>(offset); };
    if (word(offsetof(SegmentHeader, magic)) != layout::magic)
        return set_unreadable(view, Readability::damaged, "not a Tandem segment");
    view.layout_version = copy.get<std::uint32_t>(offsetof(SegmentHeader, layout_version));
    if (view.layout_version != layout::layout_version)
        return set_unreadable(view, Readability::other_layout,
                              "layout version " + std::to_string(view.layout_version) +
                                  ", this program reads " + std::to_string(layout::layout_version));
    const auto line = copy.get<std::uint32_t>(offsetof(SegmentHeader, line_bytes)),
               page = copy.get<std::uint32_t>(offsetof(SegmentHeader, page_bytes));
    if (line != layout::line || page != layout::page)
        return set_unreadable(view, Readability::other_layout,
                              "lines and pages of " + std::to_string(line) + " and " + std::to_string(page) +
                                  " bytes, this program reads " + std::to_string(layout::line) + " and " +
                                  std::to_string(layout::page));
    view.contract = word(offsetof(SegmentHeader, contract));
    view.created_ns = word(offsetof(SegmentHeader, created_ns));
    view.superseded_by = word(offsetof(SegmentHeader, superseded_by));
    for (std::size_t i = 0; i < 2; ++i) {
        view.arena_offset[i] = word(offsetof(SegmentHeader, arena_offset) + i * 8);
        view.arena_bytes[i] = word(offsetof(SegmentHeader, arena_bytes) + i * 8);
    }
    // The same checks as read_header() of segment_file.cpp, but with a reason for people instead of an Error.
    const std::uint64_t total = word(offsetof(SegmentHeader, total_bytes));
    const auto& offset = view.arena_offset;
    const auto& bytes = view.arena_bytes;
    if (total > view.file_bytes)
        return set_unreadable(view, Readability::damaged,
                              "truncated: " + std::to_string(view.file_bytes) + " of " +
                                  std::to_string(total) + " bytes are left");
    const bool sound =
        copy.get<std::uint32_t>(offsetof(SegmentHeader, header_bytes)) == sizeof(SegmentHeader) &&
        total >= layout::arenas_begin && offset[0] == layout::arenas_begin && bytes[0] <= total - offset[0] &&
        offset[1] == offset[0] + bytes[0] && bytes[1] == total - offset[1] &&
        word(offsetof(SegmentHeader, generation)) == view.generation;
    if (!sound) return set_unreadable(view, Readability::damaged, "its header contradicts itself");
    view.file_bytes = total; // without the loans of calls, which follow
}

/// Returns whether a signal or a debugger has stopped the process, according to proc(5).
bool is_stopped(std::uint32_t pid) {
    std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
    std::string text;
    std::getline(file, text);
    const auto name_end = text.rfind(") "); // the name may hold any characters
    return name_end != std::string::npos && (text[name_end + 2] == 'T' || text[name_end + 2] == 't');
}

/// Sets the pid, unless it has no meaning in this pid namespace.
void set_pid(const ProcessIdentity& process, ObservedSide& side) {
    const bool elsewhere = find_process(process) == ProcessLookup::elsewhere;
    (elsewhere ? side.pid_elsewhere : side.pid) = process.pid;
}

/// Reads `taken` before it tests the lock, for the reason given in Mapping::peer_state().
void read_side(const ReadOnlySnapshot& file, ObservedSegment& view, Side which) {
    using layout::SideHeader;
    ObservedSide& side = view.sides[index_of(which)];
    Snapshot<SideHeader, offsetof(SideHeader, directory)> copy;
    const bool known = view.readability == Readability::readable &&
                       file.read(sizeof(layout::SegmentHeader) + index_of(which) * sizeof(SideHeader), copy);
    side.held = side_lives(file.fd(), which);
    if (!known) return;
    const auto word = [&](std::size_t offset) { return copy.get<std::uint64_t>(offset); };
    set_pid({copy.get<std::uint32_t>(offsetof(SideHeader, pid)), word(offsetof(SideHeader, pid_namespace)),
             word(offsetof(SideHeader, time_namespace)), word(offsetof(SideHeader, start_ticks))},
            side);
    side.joined_ns = copy.get<std::uint64_t>(offsetof(SideHeader, joined_ns));
    side.published = copy.get<std::uint32_t>(offsetof(SideHeader, published)) != 0;
    side.left = copy.get<std::uint32_t>(offsetof(SideHeader, left)) != 0;
    side.state = copy.get<std::uint32_t>(offsetof(SideHeader, taken)) == 0 ? PeerState::absent
                 : !side.held                                              ? PeerState::dead
                 : side.pid != 0 && is_stopped(side.pid)                   ? PeerState::stopped
                                                                           : PeerState::alive;
}

/// Reads the content of the file. Returns false if the file is gone.
bool read_content(const ReadOnlySnapshot& file, ObservedSegment& view) {
    if (!file && errno == ENOENT) return false;
    if (!file) {
        set_unreadable(view, Readability::damaged, "cannot be opened (" + errno_text() + ")");
        return true;
    }
    struct stat opened {};
    if (fstat(file.fd(), &opened) != 0 || !S_ISREG(opened.st_mode) || !may_use(opened))
        return false; // replaced since read_file_status() read it
    set_sizes(opened, view);
    view.device = opened.st_dev;
    view.inode = opened.st_ino;
    read_header_fields(file, view);
    for (const Side which : {Side::first, Side::second}) read_side(file, view, which);
    view.changing_hands = held_by_other(file.fd(), LockByte::hand_over);
    return true;
}

} // namespace

std::shared_ptr<const ReadOnlySnapshot> open_observed(const ObservedSegment& segment) {
    auto file = std::make_shared<const ReadOnlySnapshot>(segment.path);
    struct stat opened {};
    const bool same = *file && fstat(file->fd(), &opened) == 0 && opened.st_dev == segment.device &&
                      opened.st_ino == segment.inode;
    return same ? file : nullptr;
}

bool has_left(const ReadOnlySnapshot& file, Side side) {
    using layout::SideHeader;
    Snapshot<SideHeader, offsetof(SideHeader, directory)> copy;
    return file.read(sizeof(layout::SegmentHeader) + index_of(side) * sizeof(SideHeader), copy) &&
           copy.get<std::uint32_t>(offsetof(SideHeader, left)) != 0;
}

std::vector<ObservedSegment> observe_segments(std::size_t* left_out) {
    std::vector<ObservedSegment> found;
    std::size_t foreign = 0;
    for (const auto& [link, generation] : list_segment_names()) {
        auto view = read_file_status(link, generation);
        if (!view) continue;
        if (view->readability == Readability::foreign && ++foreign > max_foreign) continue;
        if (view->readability == Readability::readable && !read_content(ReadOnlySnapshot(view->path), *view))
            continue;
        found.push_back(std::move(*view));
    }
    if (left_out != nullptr) *left_out = foreign - std::min(foreign, max_foreign);
    return found;
}

std::optional<Observation> observe(const std::string& link, std::uint64_t generation) {
    check_link_name(link);
    std::optional<Observation> foreign; // only if there is no other
    for (const auto candidate : list_generations(link)) {
        if (generation != 0 && candidate != generation) continue;
        auto view = read_file_status(link, candidate);
        if (!view) continue;
        Observation observation{std::move(*view), {}, {}, {}, {}};
        if (observation.segment.readability == Readability::foreign) {
            if (!foreign) foreign = std::move(observation);
            continue;
        }
        if (observation.segment.readability != Readability::readable) return observation;
        const ReadOnlySnapshot file(observation.segment.path);
        if (!read_content(file, observation.segment)) continue;
        if (observation.segment.readability == Readability::readable) observe_objects(file, observation);
        return observation;
    }
    return foreign;
}

} // namespace tandem::shm
