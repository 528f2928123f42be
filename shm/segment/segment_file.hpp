// SPDX-License-Identifier: Apache-2.0
// The files of segments: names, access rights, creation and removal.
#pragma once
#include "shm/os/file_descriptor.hpp"
#include "shm/segment/layout.hpp"
#include "shm/segment/side.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>
#include <vector>

namespace tandem::shm {

constexpr const char* shm_directory = "/dev/shm";

/// Throws Error unless is_link_name() (shm/os/link_name.hpp).
void check_link_name(const std::string& link);

std::string file_prefix(const std::string& link);                            ///< "tandem.<link>."
std::string segment_path(const std::string& link, std::uint64_t generation); ///< "/dev/shm/tandem.<link>.<n>"
/// The largest generation. Names with more digits are not segments, so that all processes see the same ones.
constexpr std::uint64_t max_generation = 999'999'999'999'999'999;

/// A name in /dev/shm that a segment could have; anyone may have given it to a file.
struct SegmentName {
    std::string link; ///< without a dot, but perhaps no valid link name
    std::uint64_t generation;
};
/// Returns the existing names, by link, newest first. Throws Error if /dev/shm cannot be listed.
std::vector<SegmentName> list_segment_names();
/// Returns the generations of the link's existing names, newest first. Throws Error if /dev/shm cannot be listed.
std::vector<std::uint64_t> list_generations(const std::string& link);

/// The users that may open a segment: only its owner (mode 0600), or also a named group (mode 0660).
struct Access {
    uid_t owner;
    std::optional<gid_t> group;
    mode_t mode() const { return group ? 0660 : 0600; }
    /// Returns whether a file is one of the link. /dev/shm is open to all users, so files of others are ignored: they are
    /// not joined, raise no generation and block no name.
    bool counts(const struct stat& file) const;
};
Access access_of_this_process(const std::string& group); ///< Throws Error for an unknown group.

/// Opens a segment's file; empty if the file does not exist or does not count. Throws Error unless its type and mode are right.
FileDescriptor open_segment(const std::string& path, const Access& access);

/// The sides that live in a segment's file (side_lives()), and whether its locks for the change of a generation are held. foreign:
/// the file does not count for `access`, and nothing else is known of it. probe_segment() opens the file for reading only, because
/// closing a file that was open for writing wakes the watchers.
struct Probe {
    bool exists = false, held[2] = {}, busy = false, foreign = false;
    bool dead() const { return exists && !foreign && !held[0] && !held[1] && !busy; }
};
Probe probe_segment(const std::string& path, const Access& access = {geteuid(), std::nullopt});

/// Returns a generation after `newest` whose name no foreign file has. Usually it is the next one; where others have taken
/// that name, it is a later one that they could not foresee. Throws Error if there is none.
std::uint64_t next_generation(const std::string& link, std::uint64_t newest, const Access& access);

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
