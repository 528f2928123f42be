// SPDX-License-Identifier: Apache-2.0
// The files of segments: names, access rights, creation and removal.
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

/// Throws Error unless the name is 1 to 64 characters of A-Z a-z 0-9 _ -
void check_link_name(const std::string& link);

std::string file_prefix(const std::string& link);                            ///< "tandem.<link>."
std::string segment_path(const std::string& link, std::uint64_t generation); ///< "/dev/shm/tandem.<link>.<n>"
/// Returns the existing generations, newest first. Throws Error if /dev/shm cannot be listed.
std::vector<std::uint64_t> list_generations(const std::string& link);

/// The users that may open a segment: only its owner (mode 0600), or also a named group (mode 0660).
struct Access {
    uid_t owner;
    std::optional<gid_t> group;
    mode_t mode() const { return group ? 0660 : 0600; }
};
Access access_of_this_process(const std::string& group); ///< Throws Error for an unknown group.

/// Opens a segment's file; empty if the file does not exist. Throws Error unless its type, owner and mode are right.
FileDescriptor open_segment(const std::string& path, const Access& access);

/// The sides that live in a segment's file (side_lives()). probe_segment() opens the file for reading only, because closing a file that
/// was open for writing wakes the watchers.
struct Probe {
    bool exists = false, held[2] = {}, busy = false;
    bool dead() const { return exists && !held[0] && !held[1] && !busy; }
};
Probe probe_segment(const std::string& path);

/// Creates an unnamed file of `bytes` bytes. create_unnamed() reserves all of them. create_sparse() reserves only the headers,
/// and requires `required_bytes` of free memory. Both throw Error naming the needed and available bytes.
FileDescriptor create_unnamed(const std::string& path, std::uint64_t bytes, const Access& access);
FileDescriptor create_sparse(const std::string& path, std::uint64_t bytes, std::uint64_t required_bytes,
                             const Access& access);

/// Reserves memory for a part of a sparse file. If there is none, reserve() throws Error naming the needed and available
/// bytes, and try_reserve() returns false.
void reserve(int fd, const std::string& path, std::uint64_t offset, std::uint64_t bytes);
bool try_reserve(int fd, std::uint64_t offset, std::uint64_t bytes);

/// Returns the free bytes in /dev/shm; empty if unknown.
std::optional<std::uint64_t> available_bytes();

/// Names an unnamed file. Returns false if another file has this name. Throws Error for any other obstacle.
bool link_unnamed(int fd, const std::string& path);

/// Returns whether the file still has a name.
bool still_named(int fd);

/// Wakes the watchers of the file (watcher.hpp) by setting its times, because stores to mapped memory wake no watcher.
void announce_change(int fd);

/// Reads the header. Throws Error unless the file size, the layout version and `contract` match.
layout::SegmentHeader read_header(int fd, const std::string& path, std::uint64_t contract);

/// Unlinks the file if it belongs to this user and no side lives in it. Returns false if it still exists.
bool remove_if_dead(const std::string& path);

/// [any-process] Removes all generations of the link in which no side lives.
void remove_dead(const std::string& link);

} // namespace tandem::shm
