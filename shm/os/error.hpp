// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cerrno>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <system_error>

namespace tandem::shm {

/// The set-up of shared memory failed. what() is one line: the segment, what is wrong, what to do.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Another living process, or another object of this process, already holds the requested side.
class SideTaken : public Error {
  public:
    using Error::Error;
};

/// The memory of a side is used up: an object of `needed` bytes does not fit into the `left` bytes.
class ArenaFull : public Error {
  public:
    ArenaFull(const std::string& what, std::uint64_t needed_bytes, std::uint64_t left_bytes)
        : Error(what), needed(needed_bytes), left(left_bytes) {}
    std::uint64_t needed, left;
};

/// Returns the text of an errno value. Thread-safe.
inline std::string errno_text(int code = errno) { return std::generic_category().message(code); }

} // namespace tandem::shm
