// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>

namespace tandem::shm {

/// Set-up of shared memory failed. what() is one line: the segment, what is wrong, what to do.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Another living process (or another object of this one) already holds the side that was asked for.
class SideTaken : public Error {
  public:
    using Error::Error;
};

/// Text of an errno value, thread-safe.
inline std::string errno_text(int code = errno) { return std::generic_category().message(code); }

} // namespace tandem::shm
