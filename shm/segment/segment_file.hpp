// SPDX-License-Identifier: Apache-2.0
// The files behind segments: their names, who may open them, how they come and go.
#pragma once
#include "shm/os/file_descriptor.hpp"
#include "shm/segment/layout.hpp"
#include "shm/segment/side.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace tandem::shm {

constexpr const char* shm_directory = "/dev/shm";

/// Throws Error unless the name is 1-64 characters of A-Z a-z 0-9 _ -
void check_link_name(const std::string& link);

std::string file_prefix(const std::string& link);                            ///< "tandem.<link>."
std::string segment_path(const std::string& link, std::uint64_t generation); ///< "/dev/shm/tandem.<link>.<n>"
std::vector<std::uint64_t> list_generations(const std::string& link);        ///< that exist now, newest first

/// Who may share a segment: its owner only (mode 0600), or also a named group (mode 0660).
struct Access {
    uid_t owner;
    std::optional<gid_t> group;
    mode_t mode() const { return group ? 0660 : 0600; }
};
Access access_of_this_process(const std::string& group); ///< Throws Error for an unknown group.

/// Opens a segment's file and checks type, owner and mode on what was opened. An empty result: it is gone.
/// Throws Error when it may not be used.
FileDescriptor open_segment(const std::string& path, const Access& access);

/// Who holds a segment's locks. Looks through a read-only descriptor, so that looking does not wake watchers.
struct Probe {
    bool exists = false, held[2] = {}, busy = false;
    bool dead() const { return exists && !held[0] && !held[1] && !busy; }
};
Probe probe_segment(const std::string& path);

/// An unnamed file of that many bytes, reserved in full; or sparse: only its headers are reserved, after a
/// look whether there is room for `at_once` bytes. Throws Error naming needed and available bytes.
FileDescriptor create_unnamed(const std::string& path, std::uint64_t bytes, const Access& access);
FileDescriptor create_sparse(const std::string& path, std::uint64_t bytes, std::uint64_t at_once,
                             const Access& access);

/// Gives memory to a part of the file that may have none yet: like create_unnamed(), or false if there is
/// none.
void reserve(int fd, const std::string& path, std::uint64_t offset, std::uint64_t bytes);
bool try_reserve(int fd, std::uint64_t offset, std::uint64_t bytes);

std::optional<std::uint64_t> available_bytes(); ///< in /dev/shm

/// Gives an unnamed file its name. False: the name is taken.
bool give_name(int fd, const std::string& path);

bool still_named(int fd); ///< Has the file not been unlinked?

/// Reads the header and checks it against the file and the caller's contract. Throws Error naming both
/// versions.
layout::SegmentHeader read_header(int fd, const std::string& path, std::uint64_t contract);

/// Unlinks the file if it is this user's and nobody lives in it. False: it is still there.
bool remove_if_dead(const std::string& path);

/// [any-process] Removes all generations of the link whose holders are all dead.
void remove_dead(const std::string& link);

} // namespace tandem::shm
